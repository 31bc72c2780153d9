# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A model bounded by a polygon in plan: as large as the polygon, nothing outside it in any output, walls instead of stairs."""
import csv
import io
import json
import math
import subprocess
import unittest

from terratet import ROOT, Case, twin_inputs

CHECKER = ROOT / "tests" / "readers" / "check_bounds.py"
VTK_PYTHON = "/usr/bin/python3"  # Debian's python3-vtk9 and python3-openvdb
INPUT = 3
HEIGHT = 1000
TOLERANCE = "7.6"  # single corners may be off by half the width where the fracture meets a wall at an acute angle
STRAYS = "0.005"
SIMPLE = [[[525200, 6791600], [525800, 6791650], [525750, 6792400], [525180, 6792300]]]
CONCAVE = [[[525180, 6791560], [525820, 6791600], [525790, 6792440], [525500, 6792440], [525510, 6792050], [525200, 6792040]],
           [[525320, 6791700], [525320, 6791880], [525560, 6791880], [525560, 6791700]]]


def wkt(rings):
    return "POLYGON(" + ",".join("(" + ",".join(f"{x} {y}" for x, y in ring + ring[:1]) + ")" for ring in rings) + ")"


def ground(x, y):
    return -40 + 0.03 * (x - 525500) - 0.02 * (y - 6792000)


class Domain(Case):
    def polygon(self, *rings_of_polygons, name="domain.csv"):
        rows = "".join(f'{k},"{wkt(rings)}"\n' for k, rings in enumerate(rings_of_polygons))
        return f"{self.write(name, 'id,WKT' + chr(10) + rows)},srs=EPSG:3067"

    def check(self, rings, *arguments):
        (self.folder / "rings.json").write_text(json.dumps(rings))
        result = subprocess.run([VTK_PYTHON, CHECKER, "--domain", "rings.json", "--tolerance", TOLERANCE, "--strays", STRAYS, *map(str, arguments)], cwd=self.folder,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(result.stdout)

    def convert(self, domain, *arguments, inputs=None):
        outputs = ["m.gpkg", "m.vtu", "m.glb", "m.vdb", "m.csv"]
        self.succeed("convert", *(inputs or twin_inputs()), "--domain", domain, *arguments, "-tr", "10", "--report", "r.json",
                     *outputs)
        return json.loads((self.folder / "r.json").read_text())

    def test_a_model_is_as_large_as_its_polygon_and_ends_at_it(self):
        for rings in (SIMPLE, CONCAVE):
            report = self.convert(self.polygon(rings), "--overwrite")
            account = next(fault for fault in report["faults"] if fault["kind"] == "domain")
            self.assertTrue(account["used"])
            self.assertAlmostEqual(account["area_in"], account["area_used"] + account["area_outside"] + account["area_trimmed"], delta=1)
            volume = sum(region["volume"] for region in report["regions"])
            area = self.check(rings, "--height", HEIGHT, "m.vdb", "m.glb") and self.area(rings)
            self.assertAlmostEqual(volume / (area * HEIGHT), 1, delta=1e-5)
            self.assertLess(account["deviation_max"], 1e-6)
            self.assertEqual(report["final"]["fault_crossing_edges"], 0)
            self.assertTrue(report["final"]["delaunay"])
            self.succeed("check", "m.gpkg")
            self.check(rings, "m.vtu")
            self.succeed("export", "--clip", "--fault-gap", "collapse", "m.gpkg", "clipped.vtu", "--overwrite")
            self.check(rings, "--height", HEIGHT, "clipped.vtu")

    def test_without_faults_the_mesh_is_the_polygons_prism_and_keeps_all_promises(self):
        inputs = twin_inputs()
        at = inputs.index("--faults")
        del inputs[at:at + 2]
        for rings in (SIMPLE, CONCAVE):
            report = self.convert(self.polygon(rings), "--overwrite", inputs=inputs)
            self.assertEqual(report["final"]["regions"], 1)
            self.assertEqual(report["final"]["fault_crossing_edges"], 0)
            self.assertAlmostEqual(report["regions"][0]["volume"] / (self.area(rings) * HEIGHT), 1, delta=1e-9)
            self.succeed("export", "--clip", "m.gpkg", "clipped.vtu", "--overwrite")
            exact = "--tolerance", 1e-3, "--strays", 0  # single precision in glTF
            self.check(rings, *exact, "--height", HEIGHT, "clipped.vtu", "m.vdb")
            self.check(rings, *exact, "m.vtu", "m.glb")
            self.succeed("check", "m.gpkg")

    def test_a_fault_that_leans_against_a_wall_parts_the_domain_and_leaves_the_wall_where_it_is(self):
        slope = math.tan(math.radians(30))
        points = [(525250 + (y - 6792000) * slope, y, z) for z in range(-980, 61, 40) for y in range(6791520, 6792500, 40)]
        self.write("f.csv", "x,y,z,fault\n" + "".join(f"{x:.3f},{y},{z},F\n" for x, y, z in points))
        inputs = twin_inputs()
        inputs[inputs.index("--faults") + 1] = "f.csv,srs=EPSG:3067"
        square = [[[525250, 6791600], [525800, 6791600], [525800, 6792400], [525250, 6792400]]]
        report = self.convert(self.polygon(square), inputs=inputs)
        domain, fault = sorted(report["faults"], key=lambda account: account["kind"])
        self.assertTrue(fault["used"])
        self.assertLess(domain["deviation_max"], 1e-6)
        self.assertEqual(report["final"]["fault_crossing_edges"], 0)
        volumes = sorted(region["volume"] for region in report["regions"])
        corner = 0.5 * 400 * 400 * slope * HEIGHT
        self.assertEqual(len(volumes), 2)
        self.assertAlmostEqual(volumes[0] / corner, 1, delta=0.005)
        self.assertAlmostEqual(sum(volumes) / (self.area(square) * HEIGHT), 1, delta=1e-5)

    def test_a_round_domain_has_walls_shorter_than_the_spacing_is_wide(self):
        ring = [[round(525500 + 300 * math.cos(k * math.pi / 60), 3), round(6792000 + 300 * math.sin(k * math.pi / 60), 3)] for k in range(120)]
        report = self.convert(self.polygon([ring]))
        volume = sum(region["volume"] for region in report["regions"])
        self.assertAlmostEqual(volume / (self.area([ring]) * HEIGHT), 1, delta=0.02)  # drawn to the spacing
        self.check([ring], "m.vtu", "m.glb")

    @staticmethod
    def area(rings):
        return abs(sum(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2 for ring in rings))

    def test_it_goes_together_with_the_ground_and_places_outside_have_no_value(self):
        step = 20
        west, south, columns, rows = 525080, 6791440, 42, 56
        lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west}", f"yllcorner {south}", f"cellsize {step}"]
        for row in reversed(range(rows)):
            lines.append(" ".join(f"{ground(west + (i + 0.5) * step, south + (row + 0.5) * step):.4f}" for i in range(columns)))
        self.write("ground.asc", "\n".join(lines) + "\n")
        report = self.convert(self.polygon(CONCAVE), "--topography", "ground.asc")
        self.check(CONCAVE, "--ground", "ground.asc", "m.vtu", "m.vdb", "m.glb")
        expected = self.integral(CONCAVE, lambda x, y: ground(x, y) + 990)
        volume = sum(region["volume"] for region in report["regions"])
        self.assertAlmostEqual(volume / expected, 1, delta=0.005)
        places = "x,y,z\n525250,6791600,-300\n525400,6791800,-300\n525150,6791520,-300\n525250,6791600,0\n"
        rows = list(csv.reader(io.StringIO(self.succeed("query", "m.gpkg", "value", self.write("p.csv", places)).stdout)))
        self.assertGreater(float(rows[1][3]), 0)  # inside; in the hole, outside and above the ground there is nothing
        self.assertEqual([row[3:] for row in rows[2:]], [[""] * len(rows[1][3:])] * 3)

    def integral(self, rings, height, step=4):
        def inside(x, y):
            crossings = 0
            for ring in rings:
                for a, b in zip(ring, ring[1:] + ring[:1]):
                    if (a[1] > y) != (b[1] > y) and x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]:
                        crossings += 1
            return crossings % 2
        xs = [525130 + (i + 0.5) * step for i in range(740 // step)]
        ys = [6791500 + (j + 0.5) * step for j in range(1000 // step)]
        return step * step * sum(height(x, y) for x in xs for y in ys if inside(x, y))

    def test_the_default_extent_is_the_polygons_box_and_any_layer_and_crs_will_do(self):
        inputs = twin_inputs()
        at = inputs.index("-te")
        del inputs[at:at + 7]
        small = [[[525250, 6791700], [525700, 6791700], [525700, 6792200], [525250, 6792200]]]
        self.write("d.csv", f'id,WKT\n1,"{wkt(small)}"\n')
        subprocess.run(["ogr2ogr", "-s_srs", "EPSG:3067", "-t_srs", "EPSG:4326", "-nln", "site", "d.gpkg", "d.csv"],
                       cwd=self.folder, check=True)
        self.convert("d.gpkg,layer=site", inputs=inputs)
        self.check(small, "m.vtu", "m.vdb", "m.glb")
        extent = json.loads(self.succeed("info", "--json", "m.gpkg").stdout)["extent"]
        for corner, expected in ((0, 525250 - 60), (3, 525700 + 60), (4, 6792200 + 60)):  # the polygon's box and L_min
            self.assertAlmostEqual(extent[corner], expected, delta=0.1)
        self.assertGreater(extent[1], 6791700 - 60)  # the data's box and L_max, which ends before

    def test_several_polygons_are_one_domain_and_a_boundary_finer_than_the_spacing_is_smoothed(self):
        left = [[[525200, 6791600], [525500, 6791600], [525500, 6792300], [525200, 6792300]]]
        right = [[[525500, 6791600], [525800, 6791600], [525800, 6792300], [525500, 6792300]]]
        self.convert(self.polygon(left, right))
        both = [[[525200, 6791600], [525800, 6791600], [525800, 6792300], [525200, 6792300]]]
        self.check(both, "m.vtu", "m.vdb", "m.glb")
        teeth = [[525200 + 6 * i, 6791600 + 3 * (i % 2)] for i in range(101)]
        fine = [teeth + [[525800, 6792300], [525200, 6792300]]]
        report = self.convert(self.polygon(fine), "--overwrite")
        self.check(both, "m.vtu", "m.vdb", "m.glb")
        self.assertIn("of 103 corners are left", " ".join(report["input"]["notes"]))

    def test_what_is_no_domain_is_refused_or_repaired_and_said(self):
        def refuse(domain, saying, code=INPUT):
            self.fail_with(code, "build", *twin_inputs(), "--domain", domain, "-q", "-o", "m.gpkg", saying=saying)
        bow = [[[525200, 6791600], [525800, 6792400], [525800, 6791600], [525200, 6792400]]]
        report = self.convert(self.polygon(bow))
        self.assertIn("MakeValid", " ".join(report["input"]["notes"]))
        triangles = [[[525200, 6791600], [525500, 6792000], [525200, 6792400]], [[525800, 6791600], [525800, 6792400], [525500, 6792000]]]
        self.check(triangles, "m.vtu", "m.vdb")
        # A section through the place where both meet: cells that reach from one to the other are outside between.
        self.check(triangles, "--tolerance", "15", "--strays", "0.02", "m.glb")
        for name in ("m.gpkg", "m.vtu", "m.glb", "m.vdb", "m.csv", "r.json"):
            (self.folder / name).unlink()
        self.write("empty.csv", "id,WKT\n")
        refuse("empty.csv,srs=EPSG:3067", "no polygon bounds a domain")
        self.write("lines.csv", 'id,WKT\n1,"LINESTRING(525200 6791600,525800 6791600,525800 6792400)"\n')
        refuse("lines.csv,srs=EPSG:3067", "polygons are needed")
        far = [[[x + 5000, y] for x, y in SIMPLE[0]]]
        refuse(self.polygon(far, name="far.csv"), "lies wholly outside")
        tiny = [[[525500 + x, 6792000 + y] for x, y in ((0, 0), (20, 0), (20, 20))]]
        refuse(self.polygon(tiny, name="tiny.csv"), "less than the square of the fault spacing")
        without_srs = [a for a in twin_inputs() if a not in ("-s_srs", "EPSG:3067")]
        self.write("bare.csv", f'id,WKT\n1,"{wkt(SIMPLE)}"\n')
        tables = [f"{a},srs=EPSG:3067" if str(a).endswith((".csv", ".ts")) else a for a in without_srs]
        self.fail_with(INPUT, "build", *tables, "--domain", "bare.csv", "-q", "-o", "m.gpkg", saying="no coordinate system is known")
        refuse(self.polygon(SIMPLE, name="ok.csv") + ",layer=nowhere", "nowhere")
        self.fail_with(2, "build", *twin_inputs(), "--domain", "ok.csv,srs=EPSG:3067", "--fault-mode", "exact", "-q", "-o", "m.gpkg",
                       saying="--fault-mode paired")


if __name__ == "__main__":
    unittest.main()
