#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a VDB file with OpenVDB's Python module and compares voxels with the tessellation in a VTU file of the same model.

check_vdb.py VDB VTU [--active N] [--local] [--samples 20]

Grids have plain names: letters, digits and _. The region is left out: Debian's module has no grids of integers.
For each grid, random active voxels must agree to 1e-5 with the linear function of the cell that holds their centre,
interpolated here, by numpy, from the VTU: in log10 for a log10 property, the class of the largest weight for a category.
In a gap cell only the vertices on the side of the nearest one count. --active: voxels that the first grid must have.
--local: the VDB was written with its local origin, which its metadata must then give.
"""
import argparse
import re
import sys

import numpy
import pyopenvdb
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, strings, tetrahedra


class Mesh:
    def __init__(self, path):
        grid = read(path)
        self.points = vtk_to_numpy(grid.GetPoints().GetData())
        self.cells = tetrahedra(grid)
        self.side = vtk_to_numpy(grid.GetPointData().GetArray("side"))
        self.fault = vtk_to_numpy(grid.GetCellData().GetArray("fault"))
        self.names = strings(grid, "Properties")
        self.scales = dict(zip(self.names, strings(grid, "PropertyScales")))
        self.names += ["extrapolation"]
        self.scales["extrapolation"] = "linear"
        self.values = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)) for name in self.names}
        self.crs = strings(grid, "CRS")[0]
        self.region = vtk_to_numpy(grid.GetCellData().GetArray("MaterialIDs"))
        self.classes = {name: strings(grid, "Classes:" + name) for name in self.names if self.scales[name] == "categorical"}
        self.classes["region"] = strings(grid, "Regions")
        corners = self.points[self.cells]
        self.low, self.high = corners.min(axis=1), corners.max(axis=1)

    def cells_at(self, p):
        """Cells that hold p, with its barycentric coordinates; more than one where p is on a facet."""
        found = []
        for c in numpy.flatnonzero(((self.low <= p) & (p <= self.high)).all(axis=1)):
            corners = self.points[self.cells[c]] - p
            matrix = (corners[1:] - corners[0]).T
            last = numpy.linalg.solve(matrix, -corners[0])
            weights = numpy.concatenate([[1 - last.sum()], last])
            if weights.min() >= -1e-9:
                found.append((c, weights))
        return found

    def values_at(self, name, cell, weights, p):
        """One, or in a gap cell that of either side."""
        if self.fault[cell] < 0:
            return [self.value(name, cell, weights, p)]
        return [self.value(name, cell, weights, p, side) for side in numpy.unique(self.side[self.cells[cell]])]

    def value(self, name, cell, weights, p, side=None):
        vertices = self.cells[cell]
        if self.fault[cell] >= 0:
            nearest = vertices[numpy.argmin(((self.points[vertices] - p) ** 2).sum(axis=1))]
            side = self.side[nearest] if side is None else side
            weights = numpy.where(self.side[vertices] == side, weights.clip(0), 0)
            weights = weights / weights.sum()
        values = self.values[name][vertices]
        if self.scales[name] == "categorical":
            return values[numpy.argmax(weights)]
        if self.scales[name] == "log10":
            return 10 ** (weights @ numpy.log10(values))
        return weights @ values


def plain(name):
    return re.sub("[^A-Za-z0-9]+", "_", name)


def active_voxels(grid):
    voxels = []
    for item in grid.citerOnValues():
        assert item.count == 1, "an active tile: a constant that the leaves should hold"
        voxels.append((*item.min, item.value))
    return voxels


def check_grid(name, grid, mesh, shift, samples):
    voxels = active_voxels(grid)
    values = numpy.array([v[3] for v in voxels])
    assert numpy.isfinite(values).all(), f"{name}: a value that is not a number is active"
    scale = mesh.scales[name]
    spread = numpy.ptp(values) or 1
    random = numpy.random.default_rng(5)
    worst = 0
    for index in random.choice(len(voxels), size=min(samples, len(voxels)), replace=False):
        i, j, k, value = voxels[index]
        p = numpy.array(grid.transform.indexToWorld((i, j, k))) + shift
        candidates = mesh.cells_at(p)
        assert candidates, f"{name}: active voxel {(i, j, k)} at {p} is in no cell"
        errors = []
        for cell, weights in candidates:
            expected = mesh.value(name, cell, weights, p)
            if scale == "log10":
                errors.append(abs(numpy.log10(value) - numpy.log10(expected)))
            elif scale == "categorical":
                errors.append(0 if value == expected else 1)
            else:
                errors.append(abs(value - expected) / max(abs(expected), spread))
        worst = max(worst, min(errors))
        assert min(errors) < 1e-5, f"{name}: voxel {(i, j, k)} has {value}, linear interpolation gives {expected}"
    return len(voxels), worst


def check_normalised(grid, normalised):
    """From 0 to 1 in decades, in the same voxels."""
    low, high = normalised["decades"]
    values, shades = active_voxels(grid), active_voxels(normalised)
    assert [v[:3] for v in values] == [v[:3] for v in shades], f"{normalised.name} has other voxels"
    expected = (numpy.log10([v[3] for v in values]) - low) / (high - low)
    assert abs(numpy.array([v[3] for v in shades]) - expected.clip(0, 1)).max() < 1e-6, f"{normalised.name} is off"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("vdb")
    arguments.add_argument("vtu")
    arguments.add_argument("--active", type=int)
    arguments.add_argument("--local", action="store_true")
    arguments.add_argument("--samples", type=int, default=20)
    wanted = arguments.parse_args()

    mesh = Mesh(wanted.vtu)
    assert pyopenvdb.readMetadata(wanted.vdb)["crs"] == mesh.crs, "the file's CRS is not the mesh's"
    for number, name in enumerate(mesh.names):
        grid = pyopenvdb.read(wanted.vdb, plain(name))
        assert isinstance(grid, pyopenvdb.FloatGrid), f"{grid.name} is no FloatGrid"
        assert grid["crs"] == mesh.crs and grid["scale"] == mesh.scales[name] and grid["property"] == name
        origin = numpy.array(grid["origin"])
        assert wanted.local == bool(origin.any()), f"{grid.name}: origin is {origin}"
        count, worst = check_grid(name, grid, mesh, origin, wanted.samples)
        if mesh.scales[name] == "log10":
            check_normalised(grid, pyopenvdb.read(wanted.vdb, plain(name) + "_normalised"))
        assert number > 0 or wanted.active in (None, count), f"{count} active voxels instead of {wanted.active}"
        print(f"{wanted.vdb}: {grid.name!r} [{grid['unit']}] {count} active voxels, largest error {worst:.1e}")


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_vdb.py: {error}")
