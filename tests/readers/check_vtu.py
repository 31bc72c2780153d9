#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a VTU file with VTK and compares it with what must be in it.

check_vtu.py FILE [--points N] [--cells N] [--box XMIN XMAX YMIN YMAX ZMIN ZMAX] [--clipped]

The box is the one that the cells fill: VTK's bounds must be it, and the cells' volumes must add up to its volume to 1e-9.
"""
import argparse
import sys

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

POINT_ARRAYS = {"role": "B", "owner": "i", "side": "b", "id": "l", "extrapolation": "d"}
CELL_ARRAYS = {"MaterialIDs": "i", "fault": "i", "in_extent": "B", "radius_edge": "f", "aspect": "f", "dihedral": "f",
               "reason": "B"}
FIELD_ARRAYS = ["CRS", "LengthUnit", "Properties", "PropertyUnits", "PropertyScales", "Faults", "Reasons"]


def read(path):
    problems = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: problems.append("VTK complains"))
    vtk.vtkObject.GlobalWarningDisplayOn()
    reader.SetFileName(path)
    reader.Update()
    assert not problems and reader.GetErrorCode() == 0, f"{path}: VTK could not read it cleanly"
    return reader.GetOutput()


def tetrahedra(grid):
    types = vtk_to_numpy(grid.GetCellTypesArray())
    assert (types == vtk.VTK_TETRA).all(), "not all cells are tetrahedra"
    return vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def volumes(points, cells):
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


def strings(grid, name):
    array = grid.GetFieldData().GetAbstractArray(name)
    assert array is not None, f"no field data {name}"
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def check_arrays(data, expected, count):
    for name, kind in expected.items():
        array = data.GetArray(name)
        assert array is not None, f"no array {name}"
        values = vtk_to_numpy(array)
        assert len(values) == count, f"{name}: {len(values)} values for {count}"
        assert values.dtype == numpy.dtype(kind), f"{name} is {values.dtype}, not {numpy.dtype(kind)}"


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("file")
    arguments.add_argument("--points", type=int)
    arguments.add_argument("--cells", type=int)
    arguments.add_argument("--box", type=float, nargs=6)
    arguments.add_argument("--clipped", action="store_true")
    wanted = arguments.parse_args()

    grid = read(wanted.file)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert points.dtype == numpy.float64, "coordinates are not Float64"
    cells = tetrahedra(grid)
    assert wanted.points in (None, len(points)), f"{len(points)} points instead of {wanted.points}"
    assert wanted.cells in (None, len(cells)), f"{len(cells)} cells instead of {wanted.cells}"
    assert len(numpy.unique(cells)) == len(points), "points that no cell uses"

    volume = volumes(points - points[0], cells)
    assert (volume > 0).all(), f"{(volume <= 0).sum()} cells are not positively oriented"
    if wanted.box:
        size = numpy.ptp(numpy.array(wanted.box).reshape(3, 2), axis=1).prod()
        error = abs(volume.sum() / size - 1)
        assert error < 1e-9, f"cells fill {volume.sum():.17g}, the box {size:.17g}: {error:.1e} off"
        assert numpy.allclose(grid.GetBounds(), wanted.box, rtol=0, atol=1e-9), f"bounds are {grid.GetBounds()}"

    check_arrays(grid.GetPointData(), POINT_ARRAYS, len(points))
    check_arrays(grid.GetCellData(), CELL_ARRAYS, len(cells))
    for name in FIELD_ARRAYS:
        strings(grid, name)
    properties = strings(grid, "Properties")
    check_arrays(grid.GetPointData(), {name: "d" for name in properties}, len(points))
    if wanted.clipped:
        assert (vtk_to_numpy(grid.GetCellData().GetArray("in_extent")) == 1).all(), "cells outside the extent"
    regions = numpy.unique(vtk_to_numpy(grid.GetCellData().GetArray("MaterialIDs")))
    print(f"{wanted.file}: {len(points)} points, {len(cells)} cells, volume {volume.sum():.12g}, "
          f"properties {properties}, regions {regions.tolist()}, CRS {strings(grid, 'CRS')[0][:40]!r}")


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_vtu.py: {error}")
