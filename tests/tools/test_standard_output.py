# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""- as an output: the same bytes as in a file, and nothing else on standard output."""
import os
import subprocess
import unittest

from terratet import PROGRAM, Case, twin_inputs


class StandardOutput(Case):
    def bytes_of(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, timeout=600,
                              env={**os.environ, "SOURCE_DATE_EPOCH": "0"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_every_single_file_format_comes_out_as_it_is_in_a_file(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        for name in ("VTU", "GLTF", "GLB", "VDB", "CSV"):
            path = "file." + name.lower()
            self.bytes_of("export", "-tr", "60", "m.gpkg", path)
            self.assertEqual(self.bytes_of("export", "-tr", "60", "--of", name, "m.gpkg", "-"),
                             (self.folder / path).read_bytes(), name)
        self.assertNotIn("-", os.listdir(self.folder))

    def test_a_conversion_may_go_there_too_beside_files(self):
        out = self.bytes_of("convert", *twin_inputs(), "--of", "CSV", "-", "table.csv")
        self.assertEqual(out, (self.folder / "table.csv").read_bytes())

    def test_without_a_format_twice_or_with_the_report_it_is_refused(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.fail_with(2, "export", "m.gpkg", "-", saying="--of")
        self.fail_with(2, "export", "--of", "CSV", "m.gpkg", "-", "-", saying="twice")
        self.fail_with(2, "export", "--of", "CSV", "--report", "-", "m.gpkg", "-", saying="report")


if __name__ == "__main__":
    unittest.main()
