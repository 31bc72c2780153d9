# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the command share: running it, the twin, a scratch folder a test."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TWIN = ROOT / "data" / "olkiluoto-twin"
PROGRAM = os.environ["TERRATET"]
EXTENT = "525130,6791500,-990,525870,6792500,10"


def twin_inputs(folder=TWIN, faults="fracture.ts"):
    """The main job's inputs; at 60 m it takes a second."""
    return ["--boreholes", folder / "collar.csv", "--survey", folder / "survey.csv", "--log", folder / "log.csv",
            "--faults", folder / faults, "--property", "K:log10:unit=m/s", "-s_srs", "EPSG:3067",
            "-te", *EXTENT.split(","), "--lmin", "60m", "--estimator", "idw:anisotropy=none"]


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="terratet test "))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_terratet(self, *arguments, environment=None):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **(environment or {})}, timeout=600)

    def succeed(self, *arguments, environment=None):
        result = self.run_terratet(*arguments, environment=environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fail_with(self, code, *arguments, saying=""):
        """Exactly one line on standard error, the right code, no output left; returns the line."""
        before = self.listing()
        result = self.run_terratet(*arguments)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("terratet: "), lines[0])
        self.assertIn(saying, lines[0])
        self.assertEqual(self.listing(), before, "something was left behind")
        return lines[0]

    def listing(self):
        return sorted(str(path) for path in self.folder.rglob("*"))

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path
