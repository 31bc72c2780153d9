# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with collapsed faults, as finite-element codes see them: read by VTK, checked from coordinates and cells alone."""
import json
import subprocess
import unittest

from terratet import ROOT, Case, twin_inputs

CHECKER = ROOT / "tests" / "readers" / "check_split.py"
VTK_PYTHON = "/usr/bin/python3"  # Debian's python3-vtk9


class Collapse(Case):
    def check(self, name, *arguments):
        result = subprocess.run([VTK_PYTHON, CHECKER, self.folder / name, *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(result.stdout)

    def test_a_collapsed_mesh_is_one_that_finite_element_codes_accept(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "kept.vtu")
        self.succeed("export", "--fault-gap", "collapse", "--margin", "--report", "hull.json", "m.gpkg", "hull.vtu")
        self.succeed("export", "-co", "FAULT_GAP=collapse", "--clip", "m.gpkg", "clipped.vtu")
        self.assertNotEqual(self.run_check("kept.vtu").returncode, 0)  # the checker tells: gap cells are no region's
        report = json.loads((self.folder / "hull.json").read_text())["collapse"]
        hull = self.check("hull.vtu")
        self.assertEqual(hull["mirrored"], report["mirrored_facets"])
        self.assertGreater(hull["mirrored"], 100)
        self.assertEqual(report["apart"], [])
        self.assertEqual(report["aside"], [])
        self.assertLess(report["volume_error"], 1e-9)
        clipped = self.check("clipped.vtu", "--extent", *twin_inputs()[twin_inputs().index("-te") + 1:][:6])
        self.assertGreater(clipped["mirrored"], 100)

    def test_so_is_one_of_an_exact_fault_which_has_its_own_triangles(self):
        self.succeed("build", *twin_inputs(), "--fault-mode", "exact", "-o", "m.gpkg")
        self.succeed("export", "--fault-gap", "collapse", "--margin", "--report", "hull.json", "m.gpkg", "hull.vtu")
        self.succeed("export", "--fault-gap", "collapse", "--clip", "m.gpkg", "clipped.vtu")
        report = json.loads((self.folder / "hull.json").read_text())["collapse"]
        self.assertEqual(self.check("hull.vtu")["mirrored"], report["mirrored_facets"])
        self.assertGreater(report["mirrored_facets"], 100)
        self.assertEqual(report["apart"] + report["aside"], [])
        self.assertAlmostEqual(report["split_area"] / report["sheet_area"], 1, delta=1e-9)
        clipped = self.check("clipped.vtu", "--extent", *twin_inputs()[twin_inputs().index("-te") + 1:][:6])
        self.assertEqual(clipped["mirrored"], report["mirrored_facets"])

    def run_check(self, name):
        return subprocess.run([VTK_PYTHON, CHECKER, self.folder / name], capture_output=True, text=True)


if __name__ == "__main__":
    unittest.main()
