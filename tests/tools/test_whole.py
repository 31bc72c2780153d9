# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs are whole or not at all, whatever stands in the way: limits, full devices, folders, inputs of the same name."""
import os
import resource
import subprocess
import unittest

from terratet import PROGRAM, Case

SAMPLES = "x,y,z,grade\n" + "".join(f"{525000 + 10 * i},{6792000 + 7 * (i % 5)},{-(i * 13) % 40},{i}\n"
                                    for i in range(30))


class Whole(Case):
    def setUp(self):
        super().setUp()
        self.write("s.csv", SAMPLES)
        self.inputs = ["--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80"]
        self.succeed("build", *self.inputs, "-o", "m.gpkg", "-q")

    def limited(self, limit, *arguments):
        """With `ulimit -f`, as a shell sets it: SIGXFSZ is at its default."""
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))

    def test_a_limit_on_the_size_of_files_is_an_error_like_any_other(self):
        before = self.listing()
        for output in ("o.vtu", "o.glb", "o.gltf", "o.vdb", "o.csv"):
            result = self.limited(1000, "export", "m.gpkg", "-q", output)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("ulimit -f", result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)
            self.assertEqual(self.listing(), before)
        for arguments in (("build", *self.inputs, "-o", "n.gpkg"),
                          ("validate", "m.gpkg", "--plot", "p.svg"),
                          ("export", "m.gpkg", "small.csv", "--report", "r.json")):
            result = self.limited(300 if "validate" in arguments else 1000, *arguments)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual([f for f in self.listing() if f not in before], [], arguments)

    def test_a_full_device_for_standard_output(self):
        for arguments in (("info", "m.gpkg"), ("info", "--json", "m.gpkg"), ("check", "m.gpkg"),
                          ("query", "m.gpkg", "value", "s.csv"), ("validate", "m.gpkg"), ("help",), ("--version",),
                          ("export", "m.gpkg", "r.vtu", "--overwrite", "--report", "-")):
            with open("/dev/full", "w") as full:
                result = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE,
                                        text=True)
            self.assertEqual(result.returncode, 1, arguments)
            self.assertIn("standard output", result.stderr)

    def test_an_output_that_is_a_folder_a_device_or_an_input(self):
        os.mkdir(self.folder / "d.vtu")
        self.fail_with(1, "export", "m.gpkg", "d.vtu", "--overwrite", saying="it is a folder")
        self.fail_with(1, "export", "m.gpkg", "/dev/full", "--of", "VTU", "--overwrite", saying="not a regular file")
        os.symlink("s.csv", self.folder / "link.csv")
        os.link(self.folder / "s.csv", self.folder / "hard.csv")
        for output in ("s.csv", "./s.csv", self.folder / "s.csv", "link.csv", "hard.csv"):
            self.fail_with(2, "convert", *self.inputs, output, "--overwrite", saying="is an input")
        self.fail_with(2, "convert", *self.inputs, "o.csv", "--report", "s.csv", "--overwrite", saying="is an input")
        self.fail_with(2, "convert", *self.inputs, "o.csv", "--report", "./o.csv", "--overwrite", saying="given twice")
        self.fail_with(2, "validate", "m.gpkg", "--plot", "m.gpkg", "--overwrite", saying="is an input")
        self.fail_with(2, "validate", "--samples", "s.csv", "-s_srs", "EPSG:3067", "--report", "s.csv", "--overwrite",
                       saying="is an input")
        self.write("recipe.toml", 'lmin = "20"\n')
        self.fail_with(2, "convert", *self.inputs, "--config", "recipe.toml", "--report", "recipe.toml", "--overwrite",
                       "o.csv", saying="is an input")
        self.assertEqual((self.folder / "s.csv").read_text(), SAMPLES)

    def test_a_folder_that_may_not_be_written_to(self):
        if os.geteuid() == 0:
            print("root may write everywhere: a read-only folder not tested")
            return
        os.mkdir(self.folder / "locked")
        os.chmod(self.folder / "locked", 0o555)
        self.fail_with(1, "export", "m.gpkg", "locked/o.vtu", saying="you may write to")


if __name__ == "__main__":
    unittest.main()
