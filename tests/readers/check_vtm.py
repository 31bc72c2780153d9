#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""VTK reads a multiblock file: the mesh of a VTU file, a line a borehole with its samples' values, the barriers.

check_vtm.py FILE.vtm CLIPPED.vtu HOLES TRIANGLES
"""
import sys

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, strings


def main():
    reader = vtk.vtkXMLMultiBlockDataReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    data = reader.GetOutput()
    names = [data.GetMetaData(i).Get(vtk.vtkCompositeDataSet.NAME()) for i in range(data.GetNumberOfBlocks())]
    assert names == ["mesh", "boreholes", "barriers"], names
    mesh, boreholes, barriers = (data.GetBlock(i) for i in range(3))
    alone = read(sys.argv[2])
    assert mesh.GetNumberOfCells() == alone.GetNumberOfCells() > 0
    assert boreholes.GetNumberOfLines() == int(sys.argv[3]) and barriers.GetNumberOfPolys() == int(sys.argv[4])
    properties = strings(alone, "Properties")
    depth = vtk_to_numpy(boreholes.GetPointData().GetArray("depth"))
    for name in properties:
        values = vtk_to_numpy(boreholes.GetPointData().GetArray(name))
        assert len(values) == len(depth) and numpy.isfinite(values).any(), name
    for line in range(boreholes.GetNumberOfLines()):
        ids = boreholes.GetCell(line).GetPointIds()
        of_line = depth[[ids.GetId(i) for i in range(ids.GetNumberOfIds())]]
        assert (numpy.diff(of_line) > 0).all(), "samples are not in the order of depth"
    assert len(strings(boreholes, "Boreholes")) == boreholes.GetNumberOfLines()
    scale = dict(zip(properties, strings(alone, "PropertyScales")))
    for name in properties:
        twin = alone.GetPointData().GetArray(name + "_log10")
        assert (twin is not None) == (scale[name] == "log10"), name
        if twin is not None:
            expected = numpy.log10(vtk_to_numpy(alone.GetPointData().GetArray(name)))
            assert numpy.allclose(vtk_to_numpy(twin), expected, equal_nan=True, rtol=0, atol=1e-12)
    gap = vtk_to_numpy(alone.GetCellData().GetArray("fault")) >= 0
    for name in ("radius_edge", "aspect", "dihedral"):
        quality = vtk_to_numpy(alone.GetCellData().GetArray(name))
        assert gap.any() and numpy.isnan(quality[gap]).all() and numpy.isfinite(quality[~gap]).all(), name


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_vtm.py: {error}")
