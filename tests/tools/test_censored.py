# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Values below a detection limit: used at the bound, and known for bounds from the log to every output."""
import csv
import json
import sqlite3
import subprocess
import unittest

from terratet import Case

COLLARS = "BHID,X,Y,Z,EOH\nA,0,0,0,40\nB,60,0,0,40\nC,0,60,0,40\nD,60,60,-5,40\n"

VTK = """
import sys, vtk
from vtk.util.numpy_support import vtk_to_numpy
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput().GetPointData()
for flag, value in zip(vtk_to_numpy(data.GetArray("K_censored")), vtk_to_numpy(data.GetArray("K"))):
    if flag:
        print(flag, value)
"""


class Censored(Case):
    def setUp(self):
        super().setUp()
        rows = ["BHID,FROM,TO,K,T"]
        for hole in "ABCD":
            for depth in range(0, 40, 5):
                rows.append(f"{hole},{depth},{depth + 5},{1e-9 * (depth + 1):g},{depth}")
        rows[3] = "A,10,15,<1e-12,10"
        rows[12] = "B,15,20,>1e-6,15"
        self.write("collar.csv", COLLARS)
        self.write("log.csv", "\n".join(rows) + "\n")

    def build(self, *more):
        self.succeed("build", "--boreholes", "collar.csv", "--log", "log.csv", "--property", "K:log10", "--property",
                     "T", "-s_srs", "local", "--lmin", "4", "--lmax", "30", "--estimator", "idw", "--report", "r.json",
                     "--overwrite", *more, "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "v.csv", "v.vtu", "--overwrite")
        with open(self.folder / "v.csv") as file:
            return list(csv.DictReader(file))

    def described(self):
        properties = json.loads(self.succeed("info", "m.gpkg", "--json").stdout)["properties"]
        return [(p["name"], p.get("censored")) for p in properties]

    def test_bounds_are_used_counted_kept_and_marked(self):
        vertices = self.build()
        marked = [(v["owner"], float(v["z"]), float(v["K"]), v["K_censored"]) for v in vertices if v["K_censored"]]
        self.assertEqual(sorted(marked), [("A", -12.5, 1e-12, "<"), ("B", -17.5, 1e-6, ">")])
        self.assertNotIn("T_censored", vertices[0])
        self.assertEqual(self.described(), [("K", 2), ("T", None)])
        self.assertIn("censored 2", self.succeed("info", "m.gpkg").stdout)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["input"]["censored"], {"K": 2})
        with sqlite3.connect(self.folder / "m.gpkg") as model:
            stored = model.execute("select borehole, K_censored from samples where K_censored is not null").fetchall()
        self.assertEqual(sorted(stored), [("A", "<"), ("B", ">")])
        self.assertIn("censored 2", self.succeed("info", "log.csv").stdout)

    def test_vtk_reads_the_marks(self):
        self.build()
        result = subprocess.run(["/usr/bin/python3", "-c", VTK, self.folder / "v.vtu"], capture_output=True, text=True)
        if "ModuleNotFoundError" in result.stderr:
            self.skipTest("VTK's Python module is not installed")
        self.assertEqual(sorted(result.stdout.splitlines()), ["1 1e-12", "2 1e-06"])

    def test_composites_with_a_censored_part_are_censored(self):
        vertices = self.build("--composite", "10")
        marked = [(v["owner"], float(v["z"]), v["K_censored"]) for v in vertices if v["K_censored"]]
        self.assertEqual(sorted(marked), [("A", -15.0, "<"), ("B", -15.0, ">")])
        self.assertEqual(self.described()[0], ("K", 2))


if __name__ == "__main__":
    unittest.main()
