# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxels as a user asks for them: where they lie, what their values are, what they take, several files in one call."""
import csv
import math
import random
import unittest

from terratet import Case, twin_inputs


class Voxels(Case):
    def model(self, *arguments):
        self.succeed("build", *twin_inputs(), *arguments, "-o", "m.gpkg")

    def blocks(self, *arguments, name="b.csv"):
        self.succeed("export", "m.gpkg", name, "--of", "BLOCKS", "--overwrite", "-q", *arguments)
        with open(self.folder / name, newline="") as file:
            return list(csv.DictReader(file))

    def queried(self, rows):
        self.write("points.csv", "x,y,z\n" + "".join(f"{r['X']},{r['Y']},{r['Z']}\n" for r in rows))
        done = self.succeed("query", "m.gpkg", "value", "points.csv", "-q")
        return list(csv.DictReader(done.stdout.splitlines()))

    def test_edges_lie_at_multiples_of_the_size_and_centres_in_the_extent(self):
        self.model()
        rows = self.blocks("-tr", "30,40,50")
        for row in rows:
            for axis, size in zip("XYZ", (30, 40, 50)):
                self.assertEqual(float(row["D" + axis]), size)
                self.assertEqual((float(row[axis]) - size / 2) % size, 0, row)
            self.assertTrue(525130 <= float(row["X"]) <= 525870 and 6791500 <= float(row["Y"]) <= 6792500, row)
        self.assertEqual(len(rows), 25 * 26 * 20)  # from 525135 to 525855; from 6791500 to 6792500; from -975 to -25
        self.assertEqual(len(self.blocks("-tr", "30,40,50", "-co", "ALIGN=NO")), 25 * 25 * 20)

    def test_estimator_values_are_those_that_query_gives_at_the_centres(self):
        for arguments in ([], ["--horizon", "hard"]):
            self.model(*arguments, "--overwrite")
            rows = self.blocks("-tr", "45", "--values", "estimator")
            linear = self.blocks("-tr", "45")
            self.assertEqual([r["X"] + r["Y"] + r["Z"] for r in rows], [r["X"] + r["Y"] + r["Z"] for r in linear])
            chosen = random.Random(1).sample(range(len(rows)), 400)
            differ = 0
            for n, asked in zip(chosen, self.queried([rows[n] for n in chosen])):
                self.assertAlmostEqual(math.log10(float(rows[n]["K"])), math.log10(float(asked["K"])), 6)
                self.assertAlmostEqual(float(rows[n]["extrapolation"]), float(asked["K_extrapolation"]), 6)
                differ += abs(math.log10(float(linear[n]["K"]) / float(rows[n]["K"]))) > 0.01
            self.assertGreater(differ, 100)

    def test_deviations_are_estimated_at_the_centres_too(self):
        self.model()
        rows = self.blocks("-tr", "90", "--values", "estimator", "--uncertainty")
        for row, asked in zip(rows[::7], self.queried(rows[::7])):
            self.assertAlmostEqual(float(row["K_sd"]), float(asked["K_sd"]), 5)

    def test_nothing_is_said_beyond_the_extrapolation_that_is_allowed(self):
        self.model()
        everything = self.blocks("-tr", "30")
        for limit in (0.2, 0.5):
            some = self.blocks("-tr", "30", "--max-extrapolation", limit)
            self.assertEqual(some, [row for row in everything if float(row["extrapolation"]) <= limit + 1e-7])
            self.assertTrue(0 < len(some) < len(everything))
        for wrong in ("1.5", "-1", "much"):
            self.fail_with(2, "export", "m.gpkg", "v.vdb", "--max-extrapolation=" + wrong, saying="--max-extrapolation")
        self.fail_with(2, "export", "m.gpkg", "v.vdb", "--values", "kriging", saying="estimator")

    def test_what_an_output_takes_is_said_first_and_large_ones_want_to_be_asked_for(self):
        self.model()
        done = self.succeed("export", "--dry-run", "m.gpkg", "v.vdb", "v.nc", "b.csv,of=BLOCKS", "m.csv", "-tr", "10", "-q")
        self.assertEqual(len(done.stdout.splitlines()), 3)
        for name, line in zip(("v.vdb", "v.nc", "b.csv"), done.stdout.splitlines()):
            self.assertIn(f"{name}: 74 × 100 × 100 voxels of 10 × 10 × 10, 740 000 in all", line)
        self.assertEqual(self.listing(), [str(self.folder / "m.gpkg")])
        self.assertIn("740 000 in all", self.succeed("export", "m.gpkg", "v.nc", "-tr", "10").stderr)
        self.fail_with(2, "export", "m.gpkg", "big.vdb", "big.tif", "-tr", "0.5", saying="--allow-large")
        done = self.succeed("export", "--dry-run", "--allow-large", "m.gpkg", "big.vdb", "-tr", "0.5")
        self.assertIn("1480 × 2000 × 2000", done.stdout)
        done = self.succeed("convert", *twin_inputs(), "--dry-run", "n.gpkg", "n.vdb", "-tr", "10")
        self.assertIn("74 × 100 × 100", done.stdout)

    def test_R6_files_written_in_one_pass_are_those_written_alone_at_any_number_of_threads(self):
        self.model()
        outputs = ["v.vdb", "v.tif", "v.nc", "b.csv,of=BLOCKS", "c.tif,of=COG"]
        names = [output.split(",")[0] for output in outputs]
        common = ["export", "m.gpkg", "-tr", "9", "--overwrite", "-q"]
        alone = {}
        for output, name in zip(outputs, names):
            self.succeed(*common, output)
            alone[name] = (self.folder / name).read_bytes()
        for threads in (1, 2):
            self.succeed(*common, *outputs, "--threads", threads)
            for name in names:
                self.assertTrue((self.folder / name).read_bytes() == alone[name], f"{name}, {threads} threads")

    def test_an_output_that_cannot_be_made_takes_none_of_the_others_along(self):
        self.model()
        self.fail_with(2, "export", "m.gpkg", "v.vdb", "v.tif,of=SHAPES", saying="SHAPES")
        self.fail_with(2, "export", "m.gpkg", ",of=VDB", saying="OUTPUT,of=FORMAT")
        self.write("v.nc", "mine")
        self.fail_with(1, "export", "m.gpkg", "v.vdb", "v.nc", saying="--overwrite")


if __name__ == "__main__":
    unittest.main()
