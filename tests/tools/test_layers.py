# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Topography and horizons over the twin: layers as thick as between their surfaces, and nothing above the ground."""
import csv
import json
import math
import subprocess
import unittest

from terratet import ROOT, Case, twin_inputs

CHECKER = ROOT / "tests" / "readers" / "check_ground.py"
BOUNDS = ROOT / "tests" / "readers" / "check_bounds.py"
VTK_PYTHON = "/usr/bin/python3"  # Debian's python3-vtk9 and python3-openvdb
LO, HI = (525130, 6791500, -990), (525870, 6792500, 60)


def ground(x, y):
    return 20 + 15 * math.sin((x - LO[0]) / 180) + 10 * math.cos((y - LO[1]) / 240)


def horizon(depth, dip):
    return lambda x, y: -depth + dip * (x - LO[0] - 370) + 12 * math.sin((y - LO[1]) / 200)


HORIZONS = [horizon(250, 0.1), horizon(480, -0.05), horizon(720, 0.15)]


class Layers(Case):
    def grid(self, name, surface, step=20, beyond=5):
        """An ASCII grid of pixels' centres, a few of them beyond the extent."""
        columns, rows = ((HI[k] - LO[k]) // step + 2 * beyond for k in (0, 1))
        west, south = (LO[k] - beyond * step for k in (0, 1))
        lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west}", f"yllcorner {south}", f"cellsize {step}"]
        for row in reversed(range(rows)):
            lines.append(" ".join(f"{surface(west + (i + 0.5) * step, south + (row + 0.5) * step):.4f}" for i in range(columns)))
        return self.write(name, "\n".join(lines) + "\n")

    def inputs(self):
        inputs = twin_inputs()
        at = inputs.index("-te") + 1
        inputs[at:at + 6] = [str(number) for number in (*LO, *HI)]
        inputs += ["--topography", self.grid("ground.asc", ground)]
        for k, surface in enumerate(HORIZONS):
            inputs += ["--surface", self.grid(f"h{k}.asc", surface)]
        return inputs

    def test_layers_have_the_volumes_between_their_surfaces_and_nothing_is_above_the_ground(self):
        middle = 525180, 6791560
        levels = [ground(*middle)] + [surface(*middle) for surface in HORIZONS] + [LO[2]]
        names = []
        for k in range(4):
            names += ["--region-name", f"{middle[0]},{middle[1]},{(levels[k] + levels[k + 1]) / 2}=layer {k}"]
        outputs = ["m.gpkg", "m.vtu", "m.glb", "m.gltf", "m.vdb", "m.csv"]
        self.succeed("convert", *self.inputs(), *names, "-tr", "10", "--report", "r.json", *outputs)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual([fault["kind"] for fault in report["faults"] if fault["used"]].count("horizon"), 3)
        self.assertEqual(report["final"]["regions"], 4)
        volumes = {region["name"]: region["volume"] for region in report["regions"]}
        tops = [ground, *HORIZONS]
        for k in range(4):
            expected = self.between(tops[k], tops[k + 1] if k < 3 else lambda x, y: LO[2])
            self.assertAlmostEqual(volumes[f"layer {k}"] / expected, 1, delta=0.005)
        self.check_ground()
        self.succeed("export", "--fault-gap", "collapse", "--clip", "--overwrite", "m.gpkg", "m.vtu")
        self.check_ground()

    def between(self, top, bottom, step=5):
        return step * step * sum(
            top(x, y) - bottom(x, y)
            for x in (LO[0] + (i + 0.5) * step for i in range((HI[0] - LO[0]) // step))
            for y in (LO[1] + (j + 0.5) * step for j in range((HI[1] - LO[1]) // step)))

    def check_ground(self):
        result = subprocess.run([VTK_PYTHON, CHECKER, self.folder / "ground.asc", self.folder / "m.vtu", self.folder / "m.vdb"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        result = subprocess.run([VTK_PYTHON, BOUNDS, "--ground", self.folder / "ground.asc", self.folder / "m.glb"],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("m.glb ground above", result.stdout)
        with open(self.folder / "m.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertGreater(len(rows), 1000)
        inside = [row for row in rows if all(LO[k] <= float(row["xy"[k]]) <= HI[k] for k in (0, 1))]
        self.assertLess(max(float(row["z"]) - ground(float(row["x"]), float(row["y"])) for row in inside), 2)

    def test_a_hard_horizon_is_kept_in_the_model_and_bars_what_it_is_hard_for(self):
        def contact(x, y):
            return -50 + 10 * math.sin(x / 40) + 0.1 * (y - 100)

        rows = [f"{x},{y},{z},{'above' if z > contact(x, y) else 'below'},{z}"
                for x in range(5, 200, 45) for y in range(5, 200, 45) for z in range(-98, 0, 7)]
        self.write("s.csv", "x,y,z,rock,grade\n" + "\n".join(rows) + "\n")
        self.write("h.csv", "name,x,y,z\n" + "\n".join(
            f"top,{x},{y},{contact(x, y):.3f}" for x in range(-60, 261, 8) for y in range(-60, 261, 8)) + "\n")
        inputs = ["--samples", "s.csv", "--surface", "h.csv", "-s_srs", "local", "-te", "0", "0", "-100", "200", "200", "0", "--lmin",
                  "20", "--fault-spacing", "12", "--property", "rock:categorical", "--property", "grade"]
        places = [(x, y, contact(x, y) + d) for x in range(12, 195, 9) for y in range(12, 195, 9) for d in (-9, -5, -2, 2, 5, 9)]
        self.write("p.csv", "x,y,z\n" + "\n".join(f"{x},{y},{z}" for x, y, z in places) + "\n")
        right, grades = {}, {}
        for how in ("soft", "hard=rock", "hard"):
            self.succeed("build", *inputs, "--horizon", how, "-o", "m.gpkg", "--overwrite", "-q")
            table = csv.DictReader(self.succeed("query", "m.gpkg", "value", "p.csv", "--no-sd", "-q").stdout.splitlines())
            rows = list(table)
            right[how] = sum((row["rock"] == "above") == (z > contact(x, y)) for row, (x, y, z) in zip(rows, places)) / len(places)
            grades[how] = [row["grade"] for row in rows]
            info = json.loads(self.succeed("info", "m.gpkg", "--json").stdout)
            self.assertEqual([p.get("horizons") for p in info["properties"]],
                             {"soft": [None, None], "hard=rock": ["hard", None], "hard": ["hard", "hard"]}[how])
        self.assertLess(right["soft"], 0.98)
        self.assertGreaterEqual(min(right["hard=rock"], right["hard"]), 0.99)
        self.assertEqual(grades["soft"], grades["hard=rock"])
        self.assertNotEqual(grades["soft"], grades["hard"])
        for how, saying in (("firm", "'firm' is not soft, hard"), ("hard=", "'hard=' is not soft, hard")):
            self.fail_with(2, "build", *inputs, "--horizon", how, "-o", "n.gpkg", saying=saying)
        self.fail_with(2, "build", *inputs, "--horizon", "hard=Au", "-q", "-o", "n.gpkg", saying="there is no property 'Au'")

    def test_ground_that_does_not_cover_the_extent_is_refused(self):
        inputs = twin_inputs() + ["--topography", self.grid("small.asc", ground, beyond=-8)]
        at = inputs.index("-te") + 1
        inputs[at:at + 6] = [str(number) for number in (*LO, *HI)]
        self.fail_with(3, "build", *inputs, "-q", "-o", "m.gpkg", saying="it must cover all of it")


if __name__ == "__main__":
    unittest.main()
