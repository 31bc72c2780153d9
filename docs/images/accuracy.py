#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/accuracy.md's picture from the sections that the benchmark leaves (Debian: python3-matplotlib).

    build/bench/tests/bench/accuracy_bench --section out
    /usr/bin/python3 docs/images/accuracy.py out docs/images/accuracy.png
"""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import numpy
from matplotlib import pyplot
from matplotlib.collections import PolyCollection

ROWS = [("layer", "thin layer", (250, 750, 150, 400)), ("zone", "raised zone along a fault", (250, 750, 125, 375))]
COLUMNS = ["the field, and Terratet's cells", "error: Terratet", "error: uniform mesh", "error: uniform grid"]


def read(folder, stem):
    truth, own, grid, mesh = numpy.fromfile(folder / f"{stem}.f32", dtype=numpy.float32).reshape(4, 500, 1000)
    cells = []
    for line in (folder / f"{stem}.txt").read_text().splitlines():
        cells.append(numpy.array(line.split(), dtype=float).reshape(-1, 2))
    return truth, cells, [own, mesh, grid]


def main(folder, picture):
    figure, axes = pyplot.subplots(2, 4, figsize=(15, 4.1), layout="constrained", sharey="row")
    for row, (stem, name, (left, right, bottom, top)) in zip(axes, ROWS):
        truth, cells, errors = read(folder, stem)
        box = (0, 1000, 0, 500)
        row[0].imshow(truth, origin="lower", extent=box, cmap="viridis", vmin=0, vmax=1)
        near = [c for c in cells if left < c[:, 0].max() and c[:, 0].min() < right
                and bottom < c[:, 1].max() and c[:, 1].min() < top]
        row[0].add_collection(PolyCollection(near, facecolors="none", edgecolors="white", linewidths=0.15))
        row[0].set_ylabel(name)
        for axis, error in zip(row[1:], errors):
            shown = axis.imshow(abs(error), origin="lower", extent=box, cmap="magma", vmin=0, vmax=0.3)
        for axis in row:
            axis.set(xlim=(left, right), ylim=(bottom, top), xticks=[left, right], yticks=[bottom, top])
    for axis, title in zip(axes[0], COLUMNS):
        axis.set_title(title, fontsize=10)
    figure.colorbar(shown, ax=axes, shrink=0.8, label="absolute error; the field reaches 1")
    figure.savefig(picture, dpi=100)


main(pathlib.Path(sys.argv[1]), sys.argv[2])
