#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the README's picture from a VTU of the twin, with VTK (Debian: python3-vtk9 xvfb).

    terratet export --clip out/olkiluoto-twin.gpkg clipped.vtu
    xvfb-run -a /usr/bin/python3 docs/images/olkiluoto-twin.py clipped.vtu docs/images/olkiluoto-twin.png
"""
import csv
import math
import pathlib
import sys

import vtk

SITE = pathlib.Path(__file__).resolve().parents[2] / "data" / "olkiluoto-twin"
CENTRE = (525500.0, 6792000.0, -490.0)  # subtracted: graphics hardware reckons in single precision


def actor(source, **properties):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetScalarVisibility("lut" in properties)
    shown = vtk.vtkActor()
    shown.SetMapper(mapper)
    if "lut" in properties:
        mapper.SetLookupTable(properties["lut"])
        mapper.UseLookupTableScalarRangeOn()
    else:
        shown.GetProperty().SetColor(properties["color"])
    shown.GetProperty().SetEdgeVisibility("edges" in properties)
    shown.GetProperty().SetEdgeColor(0.16, 0.18, 0.2)
    shown.GetProperty().SetLineWidth(0.6)
    shown.GetProperty().SetOpacity(properties.get("opacity", 1))
    return shown


def crinkled(path):
    """Cells in the extent on the far side of a vertical cut through the holes, kept whole so that they show."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    logarithm = vtk.vtkArrayCalculator()
    logarithm.SetInputConnection(reader.GetOutputPort())
    logarithm.AddScalarVariable("K", "K", 0)
    logarithm.SetFunction("log10(K)")
    logarithm.SetResultArrayName("log10 K")
    inside = vtk.vtkThreshold()
    inside.SetInputConnection(logarithm.GetOutputPort())
    inside.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "in_extent")
    inside.SetUpperThreshold(0.5)
    inside.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_UPPER)
    shift = vtk.vtkTransform()
    shift.Translate(*(-c for c in CENTRE))
    moved = vtk.vtkTransformFilter()
    moved.SetTransform(shift)
    moved.SetInputConnection(inside.GetOutputPort())
    plane = vtk.vtkPlane()
    plane.SetOrigin(-40, 40, 0)
    plane.SetNormal(-0.55, 0.83, 0)
    half = vtk.vtkExtractGeometry()
    half.SetInputConnection(moved.GetOutputPort())
    half.SetImplicitFunction(plane)
    half.ExtractInsideOff()
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(half.GetOutputPort())
    surface.Update()
    surface.GetOutput().GetPointData().SetActiveScalars("log10 K")
    return surface


def fracture():
    with open(SITE / "fracture.csv") as file:
        rows = [[float(row[axis]) - c for axis, c in zip("xyz", CENTRE)] for row in csv.DictReader(file)]
    along, down = 31, 15
    corners = [rows[0], rows[along - 1], rows[along * (down - 1)]]
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(*corners[0])
    plane.SetPoint1(*corners[1])
    plane.SetPoint2(*corners[2])
    plane.SetResolution(along - 1, down - 1)
    return plane


def holes():
    """Straight legs between survey stations: the bend within one is too small to see."""
    together = vtk.vtkAppendPolyData()
    with open(SITE / "collar.csv") as file:
        collars = {row["hole"]: [float(row[axis]) - c for axis, c in zip("xyz", CENTRE)] for row in csv.DictReader(file)}
    with open(SITE / "survey.csv") as file:
        stations = list(csv.DictReader(file))
    for hole, point in collars.items():
        points, depth = vtk.vtkPoints(), 0.0
        points.InsertNextPoint(point)
        for station in (row for row in stations if row["hole"] == hole):
            step, depth = float(station["depth"]) - depth, float(station["depth"])
            azimuth, dip = math.radians(float(station["azimuth"])), math.radians(float(station["dip"]))
            point = [point[0] + step * math.cos(dip) * math.sin(azimuth), point[1] + step * math.cos(dip) * math.cos(azimuth),
                     point[2] + step * math.sin(dip)]
            points.InsertNextPoint(point)
        line = vtk.vtkLineSource()
        line.SetPoints(points)
        together.AddInputConnection(line.GetOutputPort())
    tubes = vtk.vtkTubeFilter()
    tubes.SetInputConnection(together.GetOutputPort())
    tubes.SetRadius(5)
    tubes.SetNumberOfSides(16)
    return tubes


def viridis():
    colors = vtk.vtkColorTransferFunction()
    for share, red, green, blue in ((0, 0.267, 0.005, 0.329), (0.25, 0.229, 0.322, 0.546), (0.5, 0.128, 0.567, 0.551),
                                    (0.75, 0.369, 0.789, 0.383), (1, 0.993, 0.906, 0.144)):
        colors.AddRGBPoint(-12 + 3.6 * share, red, green, blue)
    return colors


def main(mesh, picture):
    colors = viridis()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor(crinkled(mesh), lut=colors, edges=True))
    renderer.AddActor(actor(fracture(), color=(0.85, 0.25, 0.15), opacity=0.75))
    renderer.AddActor(actor(holes(), color=(0.1, 0.1, 0.12)))
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("log10 K (m/s)")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.1f")
    bar.UnconstrainedFontSizeOn()
    for text, size in ((bar.GetTitleTextProperty(), 22), (bar.GetLabelTextProperty(), 20)):
        text.SetColor(0.1, 0.1, 0.1)
        text.SetFontSize(size)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    bar.SetPosition(0.88, 0.25)
    bar.SetWidth(0.08)
    bar.SetHeight(0.5)
    renderer.AddActor2D(bar)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1500, -2050, 900)
    camera.SetFocalPoint(40, 60, 45)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(26)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1120, 860)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    main(*sys.argv[1:])
