# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""R6 as a user meets it: the same bytes at any thread count and in any order of rows."""
import random
import shutil
import unittest

from terratet import Case, TWIN, twin_inputs

FORMATS = ["m.vtu", "m.glb", "m.html", "m.png", "m.vdb", "m.csv", "m.tif", "m.nc"]


class Determinism(Case):
    def outputs(self, name, inputs, *arguments, environment=None):
        folder = self.folder / name
        folder.mkdir()
        self.succeed("convert", *inputs, *arguments, folder / "m.gpkg", *(folder / file for file in FORMATS),
                     environment=environment)
        digest = self.succeed("info", "--digest", folder / "m.gpkg").stdout
        return {"digest": digest, **{file: (folder / file).read_bytes() for file in FORMATS}}

    def assert_same(self, first, other, what):
        for name in first:
            self.assertTrue(first[name] == other[name], f"{name} differs: {what}")

    def test_R6_threads_do_not_change_a_byte(self):
        for estimator in ("idw", "natural"):
            inputs = twin_inputs()
            inputs[-1] = estimator
            one = self.outputs(estimator + "1", inputs, "--threads", "1")
            for threads in ("2", "4", "8"):
                self.assert_same(one, self.outputs(estimator + threads, inputs, "--threads", threads),
                                 f"{estimator}, {threads} threads")

    def test_R6_order_of_rows_does_not_change_a_byte(self):
        straight = self.outputs("straight", twin_inputs(faults="fracture.csv"))
        for seed in range(3):
            shuffled = self.folder / f"inputs{seed}"
            shuffled.mkdir()
            shuffle = random.Random(seed).shuffle
            for name in ("collar.csv", "survey.csv", "log.csv", "fracture.csv"):
                header, *rows = (TWIN / name).read_text().splitlines()
                shuffle(rows)
                (shuffled / name).write_text("\n".join([header, *rows]) + "\n")
            self.assert_same(straight, self.outputs(f"outputs{seed}", twin_inputs(shuffled, "fracture.csv")), f"seed {seed}")

    def test_R6_three_hundred_orders_of_rows_give_one_model(self):
        """Coarse, so that three hundred runs take a minute."""
        names = ("collar.csv", "survey.csv", "log.csv", "fracture.csv")
        tables = {name: (TWIN / name).read_text().splitlines() for name in names}

        def exported(inputs):
            inputs[inputs.index("60m")] = "90m"
            self.succeed("convert", *inputs, "--overwrite", self.folder / "o.vtu", self.folder / "o.csv")
            return (self.folder / "o.vtu").read_bytes() + (self.folder / "o.csv").read_bytes()

        straight = exported(twin_inputs(faults="fracture.csv"))
        for seed in range(300):
            for name, (header, *rows) in tables.items():
                random.Random(seed).shuffle(rows)
                (self.folder / name).write_text("\n".join([header, *rows]) + "\n")
            self.assertTrue(exported(twin_inputs(self.folder, "fracture.csv")) == straight, f"seed {seed}")

    def test_SOURCE_DATE_EPOCH_makes_the_model_the_same_file(self):
        environment = {"SOURCE_DATE_EPOCH": "1700000000"}
        for name in ("a", "b"):
            self.succeed("build", *twin_inputs(), "-o", self.folder / "m.gpkg", "--overwrite", environment=environment)
            shutil.copy(self.folder / "m.gpkg", self.folder / name)
        self.assertTrue((self.folder / "a").read_bytes() == (self.folder / "b").read_bytes())
        self.assertIn("2023-11-14T22:13:20Z", self.succeed("info", "m.gpkg").stdout)
        files = {"query": ("query", "m.gpkg", "region", "-o"), "surfaces": ("export", "m.gpkg", "--of", "SURFACES")}
        for name, command in files.items():
            for copy in ("a", "b"):
                self.succeed(*command, f"{name}-{copy}.gpkg", environment=environment)
            self.assertTrue((self.folder / f"{name}-a.gpkg").read_bytes() == (self.folder / f"{name}-b.gpkg").read_bytes(), name)


if __name__ == "__main__":
    unittest.main()
