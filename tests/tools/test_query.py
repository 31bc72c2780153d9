# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""terratet query MODEL value POINTS: a row for a row, in order, with the model's own estimator."""
import csv
import io
import json
import math
import os
import sqlite3
import subprocess
import threading
import unittest
import xml.etree.ElementTree

from terratet import Case, PROGRAM, TWIN, twin_inputs


class Query(Case):
    def setUp(self):
        super().setUp()
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")

    def ask(self, text, *arguments):
        points = self.write("points.csv", text)
        return list(csv.reader(io.StringIO(self.succeed("query", "m.gpkg", "value", points, *arguments).stdout)))

    def samples(self):
        """Positions and values of the samples that are vertices, from the model's export."""
        self.succeed("export", "m.gpkg", "v.csv", "--overwrite")
        with open(self.folder / "v.csv") as file:
            return [row for row in csv.DictReader(file) if row["role"] == "sample"]

    def test_on_samples_their_values_come_back_with_no_deviation(self):
        samples = self.samples()
        rows = self.ask("x,y,z\n" + "".join(f"{s['x']},{s['y']},{s['z']}\n" for s in samples))
        self.assertEqual(rows[0], ["x", "y", "z", "K", "K_sd", "K_ci95", "K_extrapolation"])
        self.assertEqual([row[3:] for row in rows[1:]], [[s["K"], "0", "0", "0"] for s in samples])

    def test_rows_stay_in_order_with_all_their_columns_and_bad_ones_are_empty(self):
        text = 'name,Easting,Northing,RL,"a, b"\n"x, ""y""",525500,6792000,-200,1\nbad,,6792000,-200,\nlast,525510,6792010,-210,ü\n'
        rows = self.ask(text)
        self.assertEqual(rows[0], ["name", "Easting", "Northing", "RL", "a, b", "K", "K_sd", "K_ci95", "K_extrapolation"])
        self.assertEqual([row[:5] for row in rows[1:]], list(csv.reader(io.StringIO(text)))[1:])
        self.assertEqual(rows[2][5:], ["", "", "", ""])
        for row in (rows[1], rows[3]):
            self.assertGreater(float(row[5]), 0)
            self.assertGreater(float(row[6]), 0)
            self.assertGreater(float(row[7]), float(row[6]))
        piped = subprocess.run([PROGRAM, "query", "m.gpkg", "value", "-"], input=text, cwd=self.folder, text=True,
                               capture_output=True, check=True)
        self.assertEqual(list(csv.reader(io.StringIO(piped.stdout))), rows)

    def test_values_are_those_of_inverse_distance_by_hand(self):
        """Beyond the fracture's reach nothing is hidden: K from the twelve nearest of all samples, in decades."""
        self.succeed("build", *[a for a in twin_inputs() if a != "--faults" and not str(a).endswith(".ts")], "-o", "n.gpkg")
        listing = subprocess.run(["ogr2ogr", "-f", "CSV", "/vsistdout/", self.folder / "n.gpkg", "samples", "-lco",
                                  "GEOMETRY=AS_XYZ"], capture_output=True, text=True, check=True).stdout
        samples = [tuple(float(row[c]) for c in "XYZK") for row in csv.DictReader(io.StringIO(listing))]
        place = (525480.0, 6791900.0, -333.0)
        near = sorted((math.dist(place, s[:3]), s[3]) for s in samples)[:12]
        weights = [1 / d**2 for d, _ in near]
        expected = 10 ** (sum(w * math.log10(k) for w, (_, k) in zip(weights, near)) / sum(weights))
        points = self.write("p.csv", "x,y,z\n%r,%r,%r\n" % place)
        row = self.succeed("query", "n.gpkg", "value", points).stdout.splitlines()[1].split(",")
        self.assertAlmostEqual(float(row[3]) / expected, 1, places=9)

    def test_other_estimators_and_no_deviations_on_request(self):
        text = "x,y,z\n525500,6792000,-200\n"
        own, other, plain = (self.ask(text, *a)[1] for a in ([], ["--estimator", "nearest"], ["--no-sd"]))
        self.assertNotEqual(own[3], other[3])
        self.assertEqual(plain, [*own[:4], "", "", own[6]])
        for threads in ("1", "3"):
            self.assertEqual(self.ask(text, "--threads", threads)[1], own)

    def test_factors_found_by_a_build_are_stored_and_used_and_otherwise_found_there_and_then(self):
        text = "x,y,z\n525500,6792000,-200\n525450,6791950,-400\n"
        self.succeed("build", *twin_inputs(), "--uncertainty", "--report", "r.json", "-o", "u.gpkg")
        report = json.loads((self.folder / "r.json").read_text())
        known = report["estimator"]["uncertainty"]["K"]
        self.assertEqual((known["boreholes"], known["samples"]), (4, 1292))
        self.assertIn("uncertainty:sd=%r:half_width=%r:" % (known["factor_sd"], known["factor_95"]),
                      json.loads(self.succeed("info", "--json", "u.gpkg").stdout)["estimator"])
        self.assertIn("\n  uncertainty:sd=", self.succeed("info", "u.gpkg").stdout)
        points = self.write("p.csv", text)
        asked = lambda model, *a: list(csv.reader(io.StringIO(self.succeed("query", model, "value", points, *a).stdout)))
        self.assertEqual(asked("u.gpkg"), asked("m.gpkg"))
        # Its own estimator, named: found anew, and the same; another's are others.
        name = report["estimator"]["name"]
        self.assertEqual(asked("u.gpkg", "--estimator", name), asked("m.gpkg"))
        self.assertNotEqual(asked("u.gpkg", "--estimator", "nearest")[1][4:6], asked("m.gpkg")[1][4:6])
        with sqlite3.connect(self.folder / "u.gpkg") as base:
            [[text]] = base.execute("SELECT value FROM terratet_meta WHERE key = 'estimator'")
        self.assertIn(" of K", text)

    def test_a_name_that_the_table_has_already_is_not_used_twice(self):
        rows = self.ask("x,y,K,z,K_sd\n525500,6792000,1e-9,-200,u\n")
        self.assertEqual(rows[0], ["x", "y", "K", "z", "K_sd", "K_estimate", "K_sd_estimate", "K_ci95", "K_extrapolation"])
        self.assertEqual(rows[1][:5], ["525500", "6792000", "1e-9", "-200", "u"])
        self.assertEqual(rows[1][5:], self.ask("x,y,z\n525500,6792000,-200\n")[1][3:])

    def test_points_are_answered_while_they_are_still_coming(self):
        """Constant memory: rows come out before standard input ends, and a million points take no more than few."""
        lines = [f"{525400 + i % 200},{6791900 + i // 200 % 300},{-100 - i % 97}\n" for i in range(140_000)]
        command = [PROGRAM, "query", "m.gpkg", "value", "-", "--no-sd", "--estimator", "nearest:anisotropy=none", "-q"]
        with subprocess.Popen(command, cwd=self.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as asked:
            writer = threading.Thread(target=lambda: (asked.stdin.write("x,y,z\n" + "".join(lines)), asked.stdin.flush()))
            writer.start()
            watchdog = threading.Timer(60, asked.kill)
            watchdog.start()
            early = [asked.stdout.readline() for _ in range(60_000)]
            self.assertTrue(early[-1], "nothing came before the input's end")
            self.assertIsNone(asked.poll())
            rest = []
            reader = threading.Thread(target=lambda: rest.extend(asked.stdout))
            reader.start()
            writer.join()
            asked.stdin.close()
            reader.join()
            watchdog.cancel()
            _, status, usage = os.wait4(asked.pid, 0)
            asked.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(asked.returncode, 0)
        rows = (early + rest)[1:]
        self.assertEqual([",".join(row.split(",")[:3]) for row in rows], [line.strip() for line in lines])
        whole = self.write("points.csv", "x,y,z\n" + "".join(lines))
        self.assertEqual(self.succeed("query", "m.gpkg", "value", whole, *command[5:]).stdout.splitlines()[1:],
                         [row.strip() for row in rows])

    def test_a_section_is_written_as_raster_and_drawing(self):
        """Each pixel holds what query cell says of its middle."""
        line = self.write("line.csv", "x,y,z\n525250,6791700,0\n525750,6792200,0\n525800,6792300,0\n")
        self.succeed("query", "m.gpkg", "section", line, "-o", "s.tif")
        self.succeed("query", "m.gpkg", "section", line, "-o", "s.svg")
        self.succeed("query", "m.gpkg", "section", "--plane=525500,6792000,-300,0,0,1", "-o", "plan.tif")
        places = []
        first = math.hypot(500, 500)
        for file, place in (("s.tif", lambda u, v: (525250 + u / first * 500, 6791700 + u / first * 500, v) if u < first
                             else (525750 + (u - first) / math.hypot(50, 100) * 50, 6792200 + (u - first) / math.hypot(50, 100) * 100, v)),
                            ("plan.tif", lambda u, v: (u, v, -300.0))):
            info = json.loads(subprocess.run(["gdalinfo", "-json", self.folder / file], capture_output=True, text=True,
                                             check=True).stdout)
            self.assertEqual(info["bands"][0]["description"], "K")
            self.assertEqual("EPSG" in info["coordinateSystem"]["wkt"] if "coordinateSystem" in info else False, file == "plan.tif")
            x0, dx, _, y0, _, dy = info["geoTransform"]
            width, height = info["size"]
            self.assertEqual(max(width, height), 2000)
            for i in range(60):
                column, row = (i * 397 + 11) % width, (i * 613 + 7) % height
                places.append((place(x0 + (column + 0.5) * dx, y0 + (row + 0.5) * dy), file, column, row))
        cells = csv.DictReader(io.StringIO(self.succeed(
            "query", "m.gpkg", "cell", self.write("c.csv", "x,y,z\n" + "".join("%r,%r,%r\n" % p[0] for p in places))).stdout))
        compared = 0
        for (_, file, column, row), cell in zip(places, cells):
            found = subprocess.run(["gdallocationinfo", "-valonly", self.folder / file, str(column), str(row)],
                                   capture_output=True, text=True, check=True).stdout.strip()
            if cell["K"] and not cell["fault"] and found != "nan":
                self.assertLess(abs(math.log10(float(found) / float(cell["K"]))), 1e-6)
                compared += 1
        self.assertGreater(compared, 80)
        drawing = xml.etree.ElementTree.parse(self.folder / "s.svg").getroot()
        count = self.succeed("query", "m.gpkg", "section", line).stdout.count("\n") - 1
        self.assertEqual(len(drawing.findall(".//{*}polygon")), count)
        self.fail_with(1, "query", "m.gpkg", "section", line, "-o", "s.tif", saying="exists")

    def test_a_section_gives_each_place_a_class_that_is_near_not_a_mean_of_numbers(self):
        """Sand lies on clay, far from any gravel, whose number is between theirs."""
        depths = [(i * 5, "sand" if i < 6 else "clay" if i < 14 else "gravel") for i in range(20)]
        holes = [(0, 0), (150, -20), (80, 150), (290, 100)]
        self.write("collar.csv", "id,x,y,z\n" + "".join(f"h{n},{x},{y},0\n" for n, (x, y) in enumerate(holes)))
        self.write("log.csv", "id,from,to,rock\n" + "".join(f"h{n},{d},{d + 5},{rock}\n" for n in range(4) for d, rock in depths))
        self.succeed("build", "--boreholes", "collar.csv", "--log", "log.csv", "--property", "rock:categorical", "-s_srs", "local",
                     "--lmin", "8", "-o", "rocks.gpkg")
        line = ("--at", "5,5,0", "--at", "285,95,0")
        rows = list(csv.DictReader(io.StringIO(self.succeed("query", "rocks.gpkg", "section", *line).stdout)))
        self.assertEqual({row["rock"] for row in rows}, {"sand", "clay", "gravel"})
        self.assertEqual([row for row in rows if row["rock"] == "gravel" and float(row["z"]) > -40], [])
        self.succeed("query", "rocks.gpkg", "section", *line, "-o", "rocks.tif")
        info = json.loads(subprocess.run(["gdalinfo", "-json", "rocks.tif"], cwd=self.folder, capture_output=True, text=True,
                                         check=True).stdout)
        x0, dx, _, y0, _, dy = info["geoTransform"]
        width, height = info["size"]
        classes = [info["bands"][0]["metadata"][""][f"CLASS_{n}"] for n in range(3)]
        self.assertEqual(classes, ["clay", "gravel", "sand"])
        pixels = [((i * 397 + 11) % width, (i * 613 + 7) % height) for i in range(400)]
        values = subprocess.run(["gdallocationinfo", "-valonly", "rocks.tif"], cwd=self.folder, capture_output=True, text=True, check=True,
                                input="".join(f"{c} {r}\n" for c, r in pixels)).stdout.split()
        along = math.hypot(280, 90)
        places = [(5 + (x0 + (c + 0.5) * dx) / along * 280, 5 + (x0 + (c + 0.5) * dx) / along * 90, y0 + (r + 0.5) * dy) for c, r in pixels]
        cells = csv.DictReader(io.StringIO(self.succeed(
            "query", "rocks.gpkg", "cell", self.write("p.csv", "x,y,z\n" + "".join("%r,%r,%r\n" % place for place in places))).stdout))
        self.assertEqual([classes[int(float(value))] for value in values], [cell["rock"] for cell in cells])

    def test_what_cannot_be_done_is_said(self):
        points = self.write("p.csv", "a,b\n1,2\n")
        self.fail_with(2, "query", "m.gpkg", "values", points, saying="did you mean value?")
        self.fail_with(2, "query", "m.gpkg", "value", points, "--side", "west", saying="'west' is neither + nor -")
        self.fail_with(3, "query", "m.gpkg", "value", points, saying="no column for x")
        self.fail_with(3, "query", "m.gpkg", "value", "none.csv", saying="none.csv")


if __name__ == "__main__":
    unittest.main()
