#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Is nothing above the ground, and does the mesh end at it? Read with VTK and OpenVDB.

check_ground.py GROUND.asc MESH.vtu VOXELS.vdb [TOLERANCE]
"""
import sys

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, tetrahedra, volumes
from vdb_grids import float_grids


def ground_of(path):
    """Bilinear between the pixels' centres of an ASCII grid."""
    with open(path) as file:
        header = {key: float(value) for key, value in (file.readline().split() for _ in range(5))}
        heights = numpy.loadtxt(file)[::-1]
    x0, y0 = (header[f"{axis}llcorner"] + header["cellsize"] / 2 for axis in "xy")

    def height(p):
        i = (p[:, 0] - x0) / header["cellsize"]
        j = (p[:, 1] - y0) / header["cellsize"]
        column = numpy.clip(i.astype(int), 0, heights.shape[1] - 2)
        row = numpy.clip(j.astype(int), 0, heights.shape[0] - 2)
        u, v = i - column, j - row
        return ((1 - v) * ((1 - u) * heights[row, column] + u * heights[row, column + 1])
                + v * ((1 - u) * heights[row + 1, column] + u * heights[row + 1, column + 1]))
    return height


def outer_facets(grid):
    """Corners of the facets around the cells inside: three arrays of places."""
    chosen = vtk.vtkThreshold()
    chosen.SetInputData(grid)
    chosen.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "in_extent")
    chosen.SetLowerThreshold(1)
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(chosen.GetOutputPort())
    surface.Update()
    shown = surface.GetOutput()
    facets = vtk_to_numpy(shown.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    corners = vtk_to_numpy(shown.GetPoints().GetData())
    return [corners[facets[:, k]] for k in range(3)]


def main():
    height = ground_of(sys.argv[1])
    tolerance = float(sys.argv[4]) if len(sys.argv) > 4 else 2.0
    grid = read(sys.argv[2])
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = tetrahedra(grid)
    assert (volumes(points, cells) > 0).all()
    inside = vtk_to_numpy(grid.GetCellData().GetArray("in_extent")) == 1
    used = numpy.unique(cells[inside])
    over = (points[used, 2] - height(points[used])).max()
    assert over < tolerance, f"VTU: a node is {over} above the ground"

    a, b, c = outer_facets(grid)  # of them those at the ground's height are the ground
    middle = (a + b + c) / 3
    near = abs(middle[:, 2] - height(middle)) < tolerance
    plan = abs(numpy.cross(b - a, c - a)[:, 2]) / 2
    box = grid.GetBounds()
    share = plan[near].sum() / ((box[1] - box[0]) * (box[3] - box[2]))
    print(f"VTU: {over:.3f} above; its upper side is the ground over {100 * share:.1f} % of the box")
    assert share > (0.995 if inside.all() else 0.5), "the mesh does not end at the ground"

    for voxels in float_grids(sys.argv[3]).values():
        indices = numpy.array([item.min for item in voxels.iterOnValues()])
        places = numpy.array([voxels.transform.indexToWorld(tuple(int(k) for k in index)) for index in indices])
        over = (places[:, 2] - height(places)).max()
        print(f"VDB {voxels.name}: {len(places)} voxels, the highest {over:.3f} above")
        assert over < tolerance, "a voxel is above the ground"
        assert over > -12, "the uppermost voxels are missing"


if __name__ == "__main__":
    main()
