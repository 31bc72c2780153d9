# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces in the formats of modelling programs and databases, through the command; VTK writes what it knows. Real files
where TERRATET_PUBLIC_DATA, or shared/data beside the checkout, is."""
import json
import os
import pathlib
import subprocess
import unittest

from terratet import Case, ROOT

DATA = pathlib.Path(os.environ.get("TERRATET_PUBLIC_DATA", ROOT.parent / "shared" / "data"))
SYSTEM_PYTHON = "/usr/bin/python3"


def table(rows, header):
    return header + "\n" + "".join(",".join(str(cell) for cell in row) + "\n" for row in rows)


class SurfaceCase(Case):
    def setUp(self):
        super().setUp()
        self.write("samples.csv", table(((500000 + 60 * i, 6000000 + 57 * j, -100 - 30 * k, i + j + k) for i in range(5)
                                         for j in range(5) for k in range(5)), "X,Y,Z,K"))

    def read(self, path, *more, role="--faults"):
        """The report of a model with this surface."""
        self.succeed("convert", "--samples", "samples.csv", role, path, "-s_srs", "EPSG:32633", "--lmin", 60, "--lmax", 300,
                     "--estimator", "nearest", "--report", "r.json", "--overwrite", "o.csv", *more)
        return json.loads((self.folder / "r.json").read_text())


class Meshes(SurfaceCase):
    def test_one_mesh_in_every_encoding_gives_one_model(self):
        made = subprocess.run([SYSTEM_PYTHON, str(pathlib.Path(__file__).parent / "write_meshes.py"), str(self.folder)],
                              capture_output=True, text=True)
        if made.returncode != 0:
            self.skipTest("no VTK for Python: " + made.stderr[-200:])
        files = sorted(self.folder.glob("*/fault.*"))
        self.assertGreaterEqual(len(files), 25)
        expected = self.read(self.folder / "ts" / "fault.ts")
        whole = (self.folder / "o.csv").read_bytes()
        self.assertTrue(expected["faults"][0]["used"])
        for path in files:
            with self.subTest(path.parent.name):
                report = self.read(path)
                self.assertEqual(report["input"]["rejected"], [])
                if path.suffix not in (".stl", ".dxf", ".ts"):  # these number their corners otherwise
                    self.assertEqual((self.folder / "o.csv").read_bytes(), whole)
                self.assertEqual(report["preprocess"]["seeds"], expected["preprocess"]["seeds"])

    def test_counts_that_a_file_cannot_hold_are_refused_before_memory_is_taken(self):
        for name, text in (
                ("a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n"),
                ("b.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\nend_header\n2000000000 1\n"),
                ("c.off", "OFF\n4000000000 1 0\n0 0 0\n"),
                ("d.irap", "-996 100000 1 1\n0 1 0 1\n100000 0 0 0\n0 0 0 0 0 0 0\n1 2\n"),
                ("e.vtp", '<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt64"><PolyData><Piece><Points>'
                          '<DataArray type="Float64" format="appended" offset="0"/></Points></Piece></PolyData>'
                          '<AppendedData encoding="raw">_\xff\xff\xff\xff\xff\xff\xff\x7f</AppendedData></VTKFile>')):
            path = self.write(name, text.encode("latin-1"))
            line = self.fail_with(3, "convert", "--samples", "samples.csv", "--faults", path, "-s_srs", "EPSG:32633", "o.vtu")
            self.assertIn(name, line)


@unittest.skipUnless(DATA.is_dir(), "SKIPPED: no public data")
class RealFiles(SurfaceCase):
    """Each file that may be a surface is opened, or refused for the right reason."""

    REFUSED = {  # part of the path: part of the message
        "borders.dxf": "no 3DFACE and no polyface mesh",
        "CFM5.3_traces.shp": "no column says their dip",
        "fault_trace.shp": "no column says their dip",
        "Traces.shp": "no column says their dip",
        "test.vo": "no usable GOCAD TSurf, VSet or PLine in it, only Voxet",
        "test.lso": "no usable GOCAD TSurf, VSet or PLine in it, only LightTSolid",
        "test.wl": "no usable GOCAD TSurf, VSet or PLine in it, only Well",
    }

    def test_all_of_them(self):
        files = [path for pattern in ("*.ts", "*.dxf", "*.vtp", "*.grd", "*.shp", "*.pl", "*.vo", "*.lso", "*.wl")
                 for path in sorted(DATA.rglob(pattern))]
        files += sorted((DATA / "loop_implicitbenchmark").rglob("F*.csv"))
        refused = {path: text for path in files for part, text in self.REFUSED.items() if part in str(path)}
        for path, text in refused.items():
            self.fail_with(3, "build", "--samples", "samples.csv", "--faults", path, "-s_srs", "EPSG:32633", "-o", "m.gpkg",
                           saying=text)
        opened = [path for path in files if path not in refused]
        self.assertGreaterEqual(len(opened), 118)
        faults = [word for path in opened for word in ("--faults", path)]
        report = self.read(opened[0], *faults[2:])
        self.assertGreaterEqual(len(report["faults"]), len(opened))


if __name__ == "__main__":
    unittest.main()
