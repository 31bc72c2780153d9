# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that end at the extent, read by VTK: whole, with cells as good as the others, with the model's values."""
import json
import math
import subprocess
import unittest

from terratet import EXTENT, ROOT, Case, twin_inputs

CHECKER = ROOT / "tests" / "readers" / "check_clipped.py"
VTK_PYTHON = "/usr/bin/python3"  # Debian's python3-vtk9


class ClipCase(Case):
    """Clipped files and the report's account of them."""

    def check(self, name, extent, lmin, *arguments):
        result = subprocess.run([VTK_PYTHON, "-B", CHECKER, self.folder / name, "--extent", *map(str, extent), "--lmin",
                                 str(lmin), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(result.stdout)

    def export(self, name, *arguments):
        """The account that the report gives of the clipped file."""
        self.succeed("export", "--clip", *arguments, "--report", "r.json", "--overwrite", "m.gpkg", name)
        return json.loads((self.folder / "r.json").read_text())["outputs"][0]["clipped"]

    def assert_good(self, shapes, account):
        """1 % at most below 10°, none below 1° and no edge below L_min/10, but what samples and faults force and is counted."""
        for key in ("cells", "below_1_deg", "below_10_deg", "short_edges"):
            self.assertEqual(shapes[key], account[key], key)
        self.assertGreater(shapes["p1"], 10)
        self.assertEqual(shapes["below_1_deg"], 0)
        if account["at_samples"] + account["at_faults"] == 0:
            self.assertGreater(shapes["min"], 10)
            self.assertEqual(shapes["short_edges"], 0)
        self.assertEqual(account["other"], 0)


class Clip(ClipCase):
    def test_cells_at_the_extent_are_as_good_as_others_and_have_the_models_values(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "--margin", "m.gpkg", "whole.vtu")
        account = self.export("clip.vtu")
        shapes = self.check("clip.vtu", EXTENT.split(","), 60, "--whole", "whole.vtu")
        self.assert_good(shapes, account)
        self.assertGreater(shapes["new_points"], 300)
        self.assertGreater(shapes["compared"], 100)
        self.assertLess(shapes["off"], 1e-9)
        account = self.export("split.vtu", "--fault-gap", "collapse")
        self.assert_good(self.check("split.vtu", EXTENT.split(","), 60, "--open"), account)

    def test_so_are_those_at_the_ground_and_at_walls(self):
        west, south, columns, rows, step = 525080, 6791440, 21, 28, 40
        lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west}", f"yllcorner {south}", f"cellsize {step}"]
        for row in reversed(range(rows)):
            y = south + (row + 0.5) * step - 6792000
            lines.append(" ".join(f"{-60 + 0.03 * x - 0.02 * y + 12 * math.sin(x / 90) * math.cos(y / 70):.3f}"
                                  for x in (west + (i + 0.5) * step - 525500 for i in range(columns))))
        self.write("ground.asc", "\n".join(lines) + "\n")
        self.write("domain.csv", 'id,WKT\n0,"POLYGON((525180 6791600,525820 6791640,525790 6792440,525210 6792380,525180 6791600))"\n')
        for bounds in (["--topography", "ground.asc"], ["--topography", "ground.asc", "--domain", "domain.csv,srs=EPSG:3067"]):
            self.succeed("build", *twin_inputs(), *bounds, "--overwrite", "-o", "m.gpkg")
            for gap in ("keep", "collapse"):
                account = self.export("clip.vtu", "--fault-gap", gap)
                self.assert_good(self.check("clip.vtu", EXTENT.split(","), 60, "--open"), account)


if __name__ == "__main__":
    unittest.main()
