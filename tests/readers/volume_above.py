# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a VTU's cells, but those in the gaps of faults, lies in a box and at or above a value, by VTK's own cutting:

    volume_above.py FILE.vtu PROPERTY VALUE x1 y1 z1 x2 y2 z2 [--log10]

Prints the volume above and that in the box. The file holds the uncut tessellation."""
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def volume(grid):
    """Of tetrahedra."""
    if grid.GetNumberOfCells() == 0:
        return 0.0
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    a, b, c, d = (points[k] for k in vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).T)
    return numpy.abs(numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a))).sum() / 6


def clipped(grid, function):
    cut = vtk.vtkClipDataSet()
    cut.SetInputData(grid)
    if function is not None:
        cut.SetClipFunction(function)
    cut.SetValue(0)
    tetrahedra = vtk.vtkDataSetTriangleFilter()  # what is left of a cell may be a wedge
    tetrahedra.SetInputConnection(cut.GetOutputPort())
    tetrahedra.TetrahedraOnlyOn()
    tetrahedra.Update()
    return tetrahedra.GetOutput()


def main(path, name, value, *rest):
    box, options = [float(x) for x in rest[:6]], rest[6:]
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    blocks = vtk.vtkThreshold()
    blocks.SetInputData(reader.GetOutput())
    blocks.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "fault")
    blocks.SetLowerThreshold(-1)  # what the function below compares with
    blocks.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_LOWER)
    blocks.Update()
    grid = blocks.GetOutput()
    level = vtk_to_numpy(grid.GetPointData().GetArray(name)).astype(float)
    above = numpy.log10(level) - numpy.log10(float(value)) if "--log10" in options else level - float(value)
    array = numpy_to_vtk(above, deep=True)
    array.SetName("above")
    grid.GetPointData().AddArray(array)
    grid.GetPointData().SetActiveScalars("above")
    for axis in range(3):
        for sign, at in ((1, box[axis]), (-1, box[axis + 3])):
            plane = vtk.vtkPlane()
            plane.SetOrigin(*[at if k == axis else 0 for k in range(3)])
            plane.SetNormal(*[sign if k == axis else 0 for k in range(3)])
            grid = clipped(grid, plane)
            grid.GetPointData().SetActiveScalars("above")
    print(repr(float(volume(clipped(grid, None)))), repr(float(volume(grid))))


if __name__ == "__main__":
    main(*sys.argv[1:])
