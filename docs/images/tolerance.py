#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/refinement.md's picture: a thin seam as 16 holes cut it, thinned by distance and to a tolerance (Debian:
python3-matplotlib, python3-vtk9).

    TERRATET=build/release/tools/terratet /usr/bin/python3 docs/images/tolerance.py docs/images/tolerance.png
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import numpy
import vtk
from matplotlib import pyplot
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

PROGRAM = os.environ.get("TERRATET", "terratet")
RUNS = [("by distance: --lmin 10", ["--lmin", "10"]), ("to a tolerance: --tolerance auto", ["--tolerance", "auto"])]
X0, Y0 = 500000, 6700000


def write_site(folder):
    rng = numpy.random.default_rng(3)
    with open(folder / "collar.csv", "w") as collar, open(folder / "log.csv", "w") as log:
        collar.write("hole,x,y,z,length\n")
        log.write("hole,from,to,au\n")
        holes = []
        for k in range(16):
            x, y = X0 + (k // 4) * 60 + rng.uniform(-5, 5), Y0 + (k % 4) * 60 + rng.uniform(-5, 5)
            holes.append((x, y))
            collar.write(f"H{k},{x},{y},0,200\n")
            top = 100 + 0.05 * (x - X0) + rng.uniform(0, .5)
            for d in range(200):
                grade = 10.0 if top <= d + .5 < top + 2 else max(0.1 + 0.02 * rng.normal(), 0.01)
                log.write(f"H{k},{d},{d + 1},{grade}\n")
    return holes


def field(mesh, points):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(mesh))
    reader.Update()
    places = vtk.vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(points, deep=1))
    wanted = vtk.vtkPolyData()
    wanted.SetPoints(places)
    probe = vtk.vtkProbeFilter()
    probe.SetSourceData(reader.GetOutput())
    probe.SetInputData(wanted)
    probe.Update()
    return vtk_to_numpy(probe.GetOutput().GetPointData().GetArray("au"))


def main(picture):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        holes = write_site(folder)
        through = [h for k, h in enumerate(holes) if k % 4 == 1]
        x = numpy.linspace(X0 - 5, X0 + 185, 600)
        y = numpy.interp(x, [h[0] for h in through], [h[1] for h in through])  # from hole to hole
        z = numpy.linspace(-125, -85, 400)
        points = numpy.stack([numpy.broadcast_to(a, (len(z), len(x))) for a in (x, y, z[:, None])], -1).reshape(-1, 3)
        top = -(100 + 0.05 * (points[:, 0] - X0) + 0.25)
        panels = [("the truth", numpy.where((points[:, 2] <= top) & (points[:, 2] > top - 2), 10, 0.1))]
        for title, options in RUNS:
            mesh = folder / "seam.vtu"
            subprocess.run([PROGRAM, "convert", "--boreholes", folder / "collar.csv", "--log", folder / "log.csv",
                            "--property", "au", "-s_srs", "EPSG:3067", *options, mesh, "--overwrite", "-q"], check=True)
            panels.append((title, field(mesh, points)))
    figure, axes = pyplot.subplots(1, 3, figsize=(15, 3.4), layout="constrained", sharey=True)
    for axis, (title, values) in zip(axes, panels):
        drawn = axis.imshow(values.reshape(len(z), len(x)), origin="lower", extent=(-5, 185, z[0], z[-1]), vmin=0, vmax=10,
                            cmap="viridis", aspect="auto")
        for hole in through:
            axis.axvline(hole[0] - X0, color="white", linewidth=0.5)
        axis.set_title(title)
        axis.set_xlabel("m")
    figure.colorbar(drawn, ax=axes, label="grade")
    figure.savefig(picture, dpi=80)


main(sys.argv[1])
