# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Queries about vertices, cells, lines, sections and volumes, against brute force over the exported vertices."""
import csv
import io
import json
import math
import random
import unittest

from terratet import Case


class VertexQueries(Case):
    def setUp(self):
        super().setUp()
        rng = random.Random(4)
        rows = [f"{rng.uniform(0, 200):.3f},{rng.uniform(0, 200):.3f},{rng.uniform(-100, 0):.3f},{rng.uniform(1, 5):.3f}" for _ in range(60)]
        self.write("s.csv", "x,y,z,v\n" + "\n".join(rows) + "\n")
        fault = [f"F,{105 + 0.3 * z},{y},{z}" for y in range(-60, 280, 20) for z in range(-160, 80, 20)]
        self.write("f.csv", "fault,x,y,z\n" + "\n".join(fault) + "\n")
        self.succeed("build", "--samples", "s.csv", "--faults", "f.csv", "-s_srs", "local", "-te", 0, 0, -100, 200, 200, 0, "--lmin", 14,
                     "-o", "m.gpkg", "-q")
        self.succeed("export", "m.gpkg", "v.csv", "-q")
        with open(self.folder / "v.csv", newline="") as file:
            table = list(csv.DictReader(file))
        self.ids = [int(r["id"]) for r in table]
        self.places = [tuple(float(r[c]) for c in "xyz") for r in table]
        self.values = [r["v"] for r in table]
        self.index = {v: i for i, v in enumerate(self.ids)}
        self.rng = random.Random(7)

    def ask(self, *words):
        return list(csv.DictReader(io.StringIO(self.succeed("query", "m.gpkg", *words, "-q").stdout)))

    def points(self, count):
        points = [tuple(self.rng.uniform(lo, hi) for lo, hi in ((-20, 220), (-20, 220), (-120, 20))) for _ in range(count)]
        points[: count // 10] = [self.rng.choice(self.places) for _ in range(count // 10)]
        self.write("p.csv", "x,y,z\n" + "\n".join(",".join(map(repr, p)) for p in points) + "\n")
        return points

    def by_query(self, rows):
        found = {}
        for row in rows:
            found.setdefault(int(row["query"]), []).append(row)
        return found

    def test_nearest_within_and_box_are_those_of_brute_force_at_ten_thousand_places(self):
        points = self.points(10000)
        nearest = self.by_query(self.ask("nearest", "p.csv", "-k", 5))
        within = self.by_query(self.ask("within", "p.csv", "-d", 12.5))
        for i, p in enumerate(points):
            distances = [math.dist(p, q) for q in self.places]
            rows = nearest[i + 1]
            for row, expected in zip(rows, sorted(distances)[:5], strict=True):
                self.assertAlmostEqual(float(row["distance"]), expected, 10)
            for row in rows:
                at = self.index[int(row["id"])]
                self.assertAlmostEqual(float(row["distance"]), distances[at], 10)
                self.assertEqual(row["v"], self.values[at])
                self.assertEqual(tuple(float(row[c]) for c in "xyz"), self.places[at])
            self.assertEqual({int(row["id"]) for row in within.get(i + 1, [])}, {v for v, d in zip(self.ids, distances) if d <= 12.5})
        for _ in range(20):
            lo = [self.rng.uniform(-20, 150), self.rng.uniform(-20, 150), self.rng.uniform(-120, -30)]
            hi = [c + self.rng.uniform(0, 80) for c in lo]
            inside = {v for v, p in zip(self.ids, self.places) if all(a <= c <= b for a, c, b in zip(lo, p, hi))}
            rows = self.ask("box", "--box", ",".join(map(repr, [*lo, *hi])))
            self.assertEqual({int(row["id"]) for row in rows}, inside)

    def test_cells_hold_their_places_and_neighbours_are_the_natural_ones(self):
        points = self.points(2000)
        rows = self.ask("cell", "p.csv")
        place_of = dict(zip(self.ids, self.places))
        cells = {}
        for row, p in zip(rows, points):
            if row["cell"]:
                corners = [place_of[int(row[f"id{k}"])] for k in range(4)]
                weights = [float(row[f"weight{k}"]) for k in range(4)]
                self.assertGreater(min(weights), -1e-8)
                for axis in range(3):
                    self.assertAlmostEqual(sum(w * c[axis] for w, c in zip(weights, corners)), p[axis], 6)
                cells[int(row["cell"])] = tuple(sorted(int(row[f"id{k}"]) for k in range(4)))
        self.assertGreater(len(cells), 500)
        neighbours = self.by_query(self.ask("neighbours", "p.csv"))
        for i, row in enumerate(rows):
            if row["cell"] and i >= 200:
                found = {int(r["id"]) for r in neighbours[i + 1]}
                self.assertLessEqual(set(cells[int(row["cell"])]), found)
                # the nearest vertex is always a natural neighbour
                self.assertIn(min(zip(self.places, self.ids), key=lambda v: math.dist(v[0], points[i]))[1], found)

    def test_a_line_tells_where_it_crosses_the_fault_and_which_regions_it_is_in(self):
        rows = self.ask("line", "--at", "20,100,-50", "--at", "180,100,-50", "--step", "10", "--no-sd")
        crossed = [row for row in rows if row["fault"]]
        self.assertEqual([row["fault"] for row in crossed], ["F"])
        self.assertAlmostEqual(float(crossed[0]["x"]), 90, 4)
        self.assertAlmostEqual(float(crossed[0]["distance"]), 70, 4)
        self.assertEqual([float(row["distance"]) for row in rows if not row["fault"]], [10.0 * i for i in range(17)])
        regions = [row["region"] for row in rows if not row["fault"] and abs(float(row["x"]) - 90) > 15]
        self.assertEqual(len(set(regions[:5])), 1)
        self.assertEqual(len(set(regions)), 2)
        down = self.ask("line", "--at", "20,20,0", "--at", "20,20,-60", "--at", "60,20,-60", "--step", "60", "--no-sd")
        self.assertEqual([float(row["distance"]) for row in down], [0, 60, 100])

    def test_volumes_add_up_and_fall_with_the_level(self):
        volumes = {row["region"]: float(row["volume"]) for row in self.ask("region")}
        self.assertEqual(len(volumes), 2)
        gap = 200 * 200 * 100 - sum(volumes.values())
        self.assertGreater(gap, 0)
        self.assertLess(gap, 0.3 * 200 * 200 * 100)
        last = None
        for level in (0.5, 1.5, 2.5, 3.5, 4.5, 6):
            above = [float(row["volume_above"]) for row in self.ask("region", "--above", f"v={level}")]
            if last is None:
                for a, v in zip(above, volumes.values()):
                    self.assertAlmostEqual(a / v, 1, 9)
            else:
                self.assertTrue(all(a <= b for a, b in zip(above, last)))
            last = above
        self.assertEqual(last, [0, 0])
        places = self.ask("region", "--at", "10,100,-50", "--at", "190,100,-50", "--at", "500,0,0")
        self.assertEqual([row["region"] != "" for row in places], [True, True, False])
        self.assertNotEqual(places[0]["region"], places[1]["region"])

    def test_sections_lie_in_their_planes_and_cover_them(self):
        self.succeed("query", "m.gpkg", "section", "--plane", "0,0,-40,0,0,1", "-o", "s.gpkg", "-q")
        self.succeed("query", "m.gpkg", "section", "--plane", "0,0,-40,0,0,1", "-o", "plane.geojson", "-q")
        area = 0
        for ring in self.rings("plane.geojson"):
            self.assertTrue(all(abs(p[2] + 40) < 1e-9 for p in ring))
            area += self.area(ring)
        self.assertLess(area, 200 * 200)
        self.assertGreater(area, 0.7 * 200 * 200)  # the fault's gap is left open
        self.write("line.csv", "x,y,z\n20,30,0\n20,170,0\n60,170,0\n")
        self.succeed("query", "m.gpkg", "section", "line.csv", "-o", "s.geojson", "-q")
        total = 0
        for ring in self.rings("s.geojson"):
            self.assertTrue(all(abs(p[0] - 20) < 1e-6 for p in ring) or all(abs(p[1] - 170) < 1e-6 for p in ring))
            total += self.area(ring)
        self.assertAlmostEqual(total / (180 * 100), 1, 9)

    def rings(self, name):
        return [f["geometry"]["coordinates"][0] for f in json.loads((self.folder / name).read_text())["features"]]

    @staticmethod
    def area(ring):
        """Of a convex polygon in space."""
        total = 0
        for a, b in zip(ring[1:], ring[2:]):
            u, v = [x - y for x, y in zip(a, ring[0])], [x - y for x, y in zip(b, ring[0])]
            total += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
        return total

    def test_words_that_do_not_fit_are_refused(self):
        for words, saying in ((["nearest"], "--at x,y,z"), (["nearest", "--at", "1,2,3", "-k", "0"], "no whole number"), (["within", "--at", "1,2,3"], "-d"),
                              (["line", "--at", "1,2,3"], "two places"), (["region", "--above", "w=1"], "not P=V"), (["nearst", "--at", "1,2,3"], "nearest"),
                              (["box"], "--box"), (["section", "--plane", "0,0,0,0,0,0"], "no length")):
            self.fail_with(2, "query", "m.gpkg", *words, saying=saying)
        self.fail_with(2, "query", "m.gpkg", "nearest", "--at", "1,2,3", "-o", "x.pdf", saying=".csv")


if __name__ == "__main__":
    unittest.main()
