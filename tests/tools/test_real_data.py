# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Real boreholes through the whole job to every output, read back by VTK and OpenVDB. The public data sets are not part of
the project: TERRATET_PUBLIC_DATA names their folder, or it is shared/data beside the checkout; without it, skipped."""
import json
import math
import os
import pathlib
import subprocess
import unittest

from terratet import Case, ROOT

DATA = pathlib.Path(os.environ.get("TERRATET_PUBLIC_DATA", ROOT.parent / "shared" / "data"))
BABBITT = DATA / "pygslib/doc/source/Tutorial_1/Babbitt"
DEMO1 = DATA / "pygslib/pygslib/data/Demo1/data"
OUTPUTS = ["m.gpkg", "m.vtu", "m.glb", "m.vdb", "m.csv"]


def dipping_fault(center, strike, dip, half_length, half_width, step):
    """Points of a plane, as a table of fault points."""
    strike, dip = math.radians(strike), math.radians(dip)
    rows = ["x,y,z,fault"]
    for i in range(-half_width // step, half_width // step + 1):
        for j in range(-half_length // step, half_length // step + 1):
            down, along = i * step, j * step
            rows.append("%.3f,%.3f,%.3f,synthetic" % (
                center[0] + along * math.sin(strike) + down * math.cos(dip) * math.cos(strike),
                center[1] + along * math.cos(strike) - down * math.cos(dip) * math.sin(strike),
                center[2] - down * math.sin(dip)))
    return "\n".join(rows) + "\n"


class RealData(Case):
    def report(self):
        return json.loads((self.folder / "report.json").read_text())

    def read_back(self, report):
        """VTK and OpenVDB agree with the report and with each other, where their Python modules are installed."""
        python = "/usr/bin/python3"
        if subprocess.run([python, "-c", "import numpy, vtk, pyopenvdb"], capture_output=True).returncode != 0:
            return
        readers = ROOT / "tests" / "readers"
        final = report["final"]
        for command in ([readers / "check_vtu.py", "m.vtu", "--points", final["vertices"], "--cells", final["tetrahedra"]],
                        [readers / "check_vdb.py", "m.vdb", "m.vtu"]):
            done = subprocess.run([python, "-B", *map(str, command)], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @unittest.skipUnless(BABBITT.exists(), "public data set pygslib is not there")
    def test_babbitt_with_a_dipping_fault(self):
        """399 holes in feet with 35,616 assay intervals; a third of them without copper."""
        fault = self.write("fault.csv", dipping_fault((2297200, 418500, 300), 55, 60, 10000, 3000, 250))
        result = self.succeed("convert", "--boreholes", BABBITT / "collar_BABBITT.csv", "--survey",
                              BABBITT / "survey_BABBITT.csv", "--log", BABBITT / "assay_BABBITT.csv", "--faults", fault,
                              "-s_srs", "EPSG:26791", "--property", "CU", "--lmin", "300", "--lmax", "1200",
                              "--report", "report.json", *OUTPUTS)
        report = self.report()
        self.assertEqual(report["input"]["boreholes"], 399)
        self.assertEqual(report["input"]["samples"], 23685)
        self.assertIn("11931 of 35616 records", result.stderr.replace("\n         ", ""))
        self.assertTrue(report["faults"][0]["used"], report["faults"])
        self.assertEqual(report["final"]["fault_crossing_edges"], 0)
        self.assertLess(report["final"]["bad_percent"], 2)
        self.assertLess(report["frame"]["origin"][2], 1e4)
        self.read_back(report)
        check = self.succeed("check", "m.gpkg")
        self.assertNotIn("FAILS", check.stdout)

    @unittest.skipUnless(DEMO1.exists(), "public data set pygslib is not there")
    def test_demo1(self):
        self.succeed("convert", "--boreholes", DEMO1 / "collar.csv", "--survey", DEMO1 / "survey.csv", "--log",
                     DEMO1 / "assay.csv", "-s_srs", "local", "--property", "Au", "--lmin", "5", "--lmax", "25",
                     "--report", "report.json", *OUTPUTS)
        report = self.report()
        self.assertEqual(report["input"]["boreholes"], 29)
        self.assertLess(report["final"]["bad_percent"], 3)
        self.read_back(report)
        self.succeed("check", "m.gpkg")


if __name__ == "__main__":
    unittest.main()
