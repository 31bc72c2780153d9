# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a scene as a person meets it: opened from disk in a headless browser with the network off. What it says is
compared with terratet query, and its volumes with VTK's."""
import csv
import io
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import unittest

from terratet import ROOT, Case, twin_inputs

READERS = ROOT / "tests" / "readers"
DATA = pathlib.Path(os.environ.get("TERRATET_PUBLIC_DATA", ROOT / ".." / "shared" / "data"))
BABBITT = DATA / "pygslib/doc/source/Tutorial_1/Babbitt"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
# Where pictures are kept to look at.
PICTURES = pathlib.Path(os.environ.get("TERRATET_PICTURES", "")) if os.environ.get("TERRATET_PICTURES") else None


@unittest.skipUnless(shutil.which("node") and CHROMIUM, "node or chromium is not installed")
class Page(Case):
    def look(self, name, **work):
        """What the page tells after it was worked with."""
        done = subprocess.run(["node", READERS / "check_page.mjs", self.folder / f"{name}.html", self.folder / f"{name}.png",
                               json.dumps(work)], capture_output=True, text=True, timeout=400,
                              env={**os.environ, "CHROMIUM": CHROMIUM})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        seen = json.loads(done.stdout)
        self.assertEqual((seen["requests"], seen["console"]), ([], []))
        self.assertLess((self.folder / f"{name}.html").stat().st_size, 5e6)
        drag = seen["drag"]
        self.assertNotEqual(drag["before"], drag["after"], "no section moved")
        print(f"{name}: first view {seen['first_view_seconds']:.1f} s, {drag['frames'] / drag['seconds']:.1f} frames a second of a drag")
        if PICTURES:
            for picture in self.folder.glob(f"{name}*.png"):
                shutil.copy(picture, PICTURES)
        return seen

    def vertices(self, count):
        """Some of the model's, off faults and within the extent."""
        self.succeed("export", "--overwrite", "m.gpkg", "v.csv")
        lo, hi = self.extent()
        with open(self.folder / "v.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["role"] in ("sample", "inserted")
                    and all(a + 1 < float(row[axis]) < b - 1 for axis, a, b in zip("xyz", lo, hi))]
        return random.Random(3).sample(rows, count)

    def extent(self):
        place = json.loads(self.succeed("info", "--json", "m.gpkg").stdout)["extent"]
        numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e[-+]?\d+)?", json.dumps(place))]
        return numbers[:3], numbers[3:6]

    def ask(self, rows):
        table = self.write("places.csv", "px,py,pz\n" + "".join(f"{row['x']},{row['y']},{row['z']}\n" for row in rows))
        out = self.succeed("query", "m.gpkg", "value", table, "--no-sd", "--columns", "x=px", "--columns", "y=py",
                           "--columns", "z=pz").stdout
        return list(csv.DictReader(io.StringIO(out)))

    def volume_above(self, name, value, *options):
        whole = ["--margin"] if "--margin" in self.succeed("export", "--help").stdout else []
        self.succeed("export", "--overwrite", *whole, "m.gpkg", "whole.vtu")
        lo, hi = self.extent()
        out = subprocess.run(["/usr/bin/python3", READERS / "volume_above.py", self.folder / "whole.vtu", name, str(value),
                              *map(str, lo + hi), *options],
                             capture_output=True, text=True, check=True).stdout
        return [float(x) for x in out.split()]

    def each_does_something(self, controls, at_least):
        """Picture, address or page tell of each; saving a picture alone leaves all three."""
        names = [control["name"] for control in controls if control["visible"]]
        self.assertGreaterEqual(len(names), at_least, names)
        dead = [control["name"] for control in controls if control["visible"] and not control["changed"]]
        self.assertEqual(dead, ["button:submit save"])

    def compare(self, name, property_name, cut, *options, hole=None, **work):
        """Values at vertices to 1e-5, the volume above the cut-off to 0.1 %."""
        rows = self.vertices(5)
        seen = self.look(name, picks=[[float(row[axis]) for axis in "xyz"] for row in rows], cut=cut, hole=hole,
                         property="extrapolation", **work)
        for pick, answer in zip(seen["picks"], self.ask(rows)):
            said = float(pick[property_name].split()[0].replace("\u2212", "-"))
            self.assertAlmostEqual(said / float(answer[property_name]), 1, delta=1e-5)
        above, whole = self.volume_above(property_name, cut, *options)
        self.assertGreater(above, 0.01 * whole)
        self.assertLess(above, 0.99 * whole)
        self.assertAlmostEqual(seen["volume"]["value"] / above, 1, delta=1e-5)
        told = csv.DictReader(io.StringIO(self.succeed("query", "m.gpkg", "region", "--above", f"{property_name}={cut}").stdout))
        self.assertAlmostEqual(sum(float(row["volume_above"]) for row in told) / above, 1, delta=1e-5)
        self.assertIn("extrapolation", seen["property_legend"])
        return seen

    def test_the_twin_in_decades_with_a_fault(self):
        self.succeed("convert", *twin_inputs(), "m.gpkg", "twin.html")
        seen = self.compare("twin", "K", 1e-10, "--log10", hole="OT-02", controls=True)
        self.each_does_something(seen["controls"], 35)
        self.assertIn("K [m/s]", seen["legend"])
        self.assertIn("1e-10", seen["legend"].replace("\u2212", "-"))
        self.assertIn("EPSG:3067", seen["crs"])
        self.assertEqual(seen["holes"], ["OT-01", "OT-02", "OT-03", "OT-04"])
        self.assertEqual(seen["strip_intervals"], 323)
        self.assertRegex(seen["honesty"], r"1.292 samples .*R².*Terratet")

    def test_classes_with_blocks(self):
        """Three kinds of rock on the two sides of a wall."""
        rows = ["hole,from,to,rock"]
        collars = ["hole,x,y,z"]
        for hole in range(16):
            x, y = 20 + 53 * (hole % 4), 20 + 53 * (hole // 4)
            collars.append(f"H{hole},{x},{y},0")
            for top in range(0, 90, 5):
                rows.append(f"H{hole},{top},{top + 5},{'granite' if x > 100 else 'gneiss' if top < 40 else 'schist <1>'}")
        self.write("collar.csv", "\n".join(collars) + "\n")
        self.write("log.csv", "\n".join(rows) + "\n")
        fault = [f"wall,100,{y},{z}" for y in range(-60, 280, 20) for z in range(-160, 80, 20)]
        self.write("fault.csv", "fault,x,y,z\n" + "\n".join(fault) + "\n")
        self.succeed("convert", "--boreholes", "collar.csv", "--log", "log.csv", "--faults", "fault.csv", "-s_srs", "local",
                     "--property", "rock:categorical", "-te", "0", "0", "-100", "200", "200", "0", "--lmin", "10", "--estimator", "nearest",
                     "m.gpkg", "rocks.html", "rocks.glb")
        rows = self.vertices(6)
        seen = self.look("rocks", picks=[[float(row[axis]) for axis in "xyz"] for row in rows], hole="H3", property="block",
                         controls=True)
        self.each_does_something(seen["controls"], 36)
        for pick, answer in zip(seen["picks"], self.ask(rows)):
            self.assertEqual(pick["rock"], answer["rock"])
            self.assertRegex(pick["block"], "region [01]")
        for name in ("granite", "gneiss", "schist <1>"):
            self.assertIn(name, seen["legend"])
        self.assertIn("region 1", seen["property_legend"])
        self.assertEqual(seen["strip_intervals"], 18)
        document = (self.folder / "rocks.html").read_text()
        self.assertIn("schist &lt;1&gt;", document.split("<script")[0])

    @unittest.skipUnless(BABBITT.exists(), "public data set pygslib is not there")
    def test_babbitt_with_a_fault(self):
        fault = ["x,y,z,fault"]
        for down in range(-3000, 3001, 250):
            for along in range(-10000, 10001, 250):
                strike, dip = math.radians(55), math.radians(60)
                fault.append("%.3f,%.3f,%.3f,F" % (2297200 + along * math.sin(strike) + down * math.cos(dip) * math.cos(strike),
                                                   418500 + along * math.cos(strike) - down * math.cos(dip) * math.sin(strike),
                                                   300 - down * math.sin(dip)))
        self.write("fault.csv", "\n".join(fault) + "\n")
        self.succeed("convert", "--boreholes", BABBITT / "collar_BABBITT.csv", "--survey", BABBITT / "survey_BABBITT.csv",
                     "--log", BABBITT / "assay_BABBITT.csv", "--faults", "fault.csv", "-s_srs", "EPSG:26791", "--property", "CU:unit=%",
                     "--lmin", "300", "--lmax", "1200", "m.gpkg", "babbitt.html", "plain.glb")
        self.succeed("export", "--compress", "m.gpkg", "packed.glb")
        self.assertLess((self.folder / "plain.glb").stat().st_size, 3.5e6)
        self.assertLess((self.folder / "packed.glb").stat().st_size, 1.2e6)
        seen = self.compare("babbitt", "CU", 0.6, hole="B1-001")
        self.assertEqual(len(seen["holes"]), 399)


class Source(unittest.TestCase):
    @unittest.skipUnless(shutil.which("node") and shutil.which("npm"), "node or npm is not installed")
    def test_the_committed_page_is_what_its_source_makes(self):
        import tempfile
        page = ROOT / "io" / "write" / "scene_page"
        self.assertLessEqual((page / "page.html").stat().st_size, 700_000)
        with tempfile.TemporaryDirectory(prefix="terratet test ") as folder:
            copy = pathlib.Path(folder) / "page"
            shutil.copytree(page, copy, ignore=shutil.ignore_patterns("node_modules"))
            subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=copy, check=True, capture_output=True)
            done = subprocess.run(["node", "build.mjs", "--check"], cwd=copy, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            done = subprocess.run(["node", "--test", "test/"], cwd=copy, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
