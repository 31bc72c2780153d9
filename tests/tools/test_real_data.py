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
from random import Random

from terratet import Case, ROOT

DATA = pathlib.Path(os.environ.get("TERRATET_PUBLIC_DATA", ROOT.parent / "shared" / "data"))
BABBITT = DATA / "pygslib/doc/source/Tutorial_1/Babbitt"
DEMO1 = DATA / "pygslib/pygslib/data/Demo1/data"
SCEC = DATA / "scec_cfm"
VENTURA = ["VNTB-Ventura_fault_steep", "PPTV-Pitas_Point_fault_east", "RDMT-Red_Mountain_fault_S_strand",
           "VNTB-Southern_San_Cayetano_fault_steep", "ORFZ-MULT-Oak_Ridge", "ORFZ-OFFS-Mid_Channel",
           "ORFZ-SFNV-Northridge_Frew", "SCLV-Del_Valle", "SCLV-Holser", "SCFZ-TOPA-San_Cayetano", "MSNH-Mission_Hills",
           "SFNV-Northridge_Hills", "SFNV-San_Fernando", "SSFZ-MULT-Santa_Susana", "SSRZ-MULT-Simi"]
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


def made_up_wells(box, count):
    """Collars and logs of vertical wells with a smooth property."""
    random = Random(4)
    collars, log = ["hole,x,y,z"], ["hole,from,to,value"]
    for hole in range(count):
        x, y = (random.uniform(box[k] + 2000, box[k + 2] - 2000) for k in (0, 1))
        collars.append("W%d,%.1f,%.1f,0" % (hole, x, y))
        for top in range(0, int(random.uniform(2000, 9000)), 100):
            value = math.sin(x / 9000) + math.cos(y / 7000) + top / 4000
            log.append("W%d,%d,%d,%.4f" % (hole, top, top + 100, value))
    return "\n".join(collars) + "\n", "\n".join(log) + "\n"


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
        result = self.succeed("convert", "--margin", "--boreholes", BABBITT / "collar_BABBITT.csv", "--survey",
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
        self.succeed("convert", "--margin", "--boreholes", DEMO1 / "collar.csv", "--survey", DEMO1 / "survey.csv", "--log",
                     DEMO1 / "assay.csv", "-s_srs", "local", "--property", "Au", "--lmin", "5", "--lmax", "25",
                     "--report", "report.json", *OUTPUTS)
        report = self.report()
        self.assertEqual(report["input"]["boreholes"], 29)
        self.assertLess(report["final"]["bad_percent"], 3)
        self.read_back(report)
        self.succeed("check", "m.gpkg")

    @unittest.skipUnless(SCEC.exists(), "public data set scec_cfm is not there")
    def test_fifteen_faults_that_meet_and_made_up_wells(self):
        """All guarantees hold on the Ventura, Oak Ridge, San Cayetano, Northridge and San Fernando faults in exact mode."""
        files = [path for path in sorted(SCEC.rglob("*.ts")) if any(part in path.name for part in VENTURA)]
        first = {next(part for part in VENTURA if part in path.name): path for path in reversed(files)}
        self.assertEqual(len(first), 15)
        collars, log = made_up_wells((225500, 3777000, 382700, 3828600), 40)
        faults = [argument for path in sorted(first.values()) for argument in ("--faults", path)]
        self.succeed("build", "--boreholes", self.write("collar.csv", collars), "--log", self.write("log.csv", log),
                     *faults, "-s_srs", "EPSG:32611", "--property", "value", "--estimator", "idw", "--fault-mode", "exact",
                     "--fault-spacing", "2000", "--lmin", "1500", "--lmax", "6000", "--report", "report.json", "-o", "m.gpkg")
        report = self.report()
        self.assertGreaterEqual(sum(fault["used"] for fault in report["faults"]), 14, report["faults"])
        self.assertEqual(report["final"]["fault_crossing_edges"], 0)
        triangles, certified = (sum(fault[key] for fault in report["faults"]) for key in ("triangles", "certified"))
        self.assertGreater(certified, 0.85 * triangles)
        check = self.succeed("check", "m.gpkg")
        self.assertNotIn("FAILS", check.stdout)


if __name__ == "__main__":
    unittest.main()
