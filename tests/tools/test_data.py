# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The twin's files are what their generator writes, to the byte."""
import csv
import subprocess
import sys
import unittest

from terratet import Case, TWIN


class Data(Case):
    def test_the_generator_writes_the_committed_files(self):
        subprocess.run([sys.executable, "-B", TWIN / "generate.py", self.folder], check=True)
        names = {path.name for path in self.folder.iterdir()}
        self.assertEqual(names, {"collar.csv", "survey.csv", "log.csv", "fracture.csv", "fracture.ts"})
        for name in names:
            self.assertEqual((self.folder / name).read_bytes(), (TWIN / name).read_bytes(), name)

    def test_the_twin_has_the_papers_numbers(self):
        with open(TWIN / "log.csv") as file:
            values = [float(row["K"]) for row in csv.DictReader(file)]
        self.assertEqual(len(values), 1292)
        self.assertGreaterEqual(min(values), 1e-12)
        self.assertLessEqual(max(values), 1e-8)
        with open(TWIN / "fracture.csv") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 465)


if __name__ == "__main__":
    unittest.main()
