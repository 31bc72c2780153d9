# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes one mesh in every encoding that VTK knows of VTP, PLY and STL: write_meshes.py FOLDER, with vtk's Python."""
import pathlib
import sys

import vtk


def mesh(n=9):
    points, triangles = vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetDataTypeToDouble()
    for i in range(n):
        for j in range(n):
            points.InsertNextPoint(500000 + 50 * i, 6000000 + 50 * j, -100 - 20 * i + 3 * (j % 3))
    for i in range(n - 1):
        for j in range(n - 1):
            a = i * n + j
            for corners in ((a, a + n, a + n + 1), (a, a + n + 1, a + 1)):
                triangles.InsertNextCell(3)
                for corner in corners:
                    triangles.InsertCellPoint(corner)
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(triangles)
    return data


def main(folder):
    data = mesh()

    def place(kind, extension):
        path = pathlib.Path(folder, kind)
        path.mkdir()
        return str(path / f"fault.{extension}")

    for mode, name in ((0, "ascii"), (1, "base64"), (2, "appended")):
        for zlib in (False, True):
            for order in (0, 1):
                for header in (64,) if order else (32,):
                    for encode in (0, 1) if mode == 2 else (0,):
                        writer = vtk.vtkXMLPolyDataWriter()
                        writer.SetInputData(data)
                        writer.SetDataMode(mode)
                        writer.SetByteOrder(order)
                        writer.SetHeaderType(header)
                        writer.SetCompressor(vtk.vtkZLibDataCompressor() if zlib else None)
                        writer.SetBlockSize(1024)
                        writer.SetEncodeAppendedData(encode)
                        writer.SetFileName(place(f"vtp_{name}_{'zlib' if zlib else 'plain'}_{order}_{header}_{encode}", "vtp"))
                        writer.Write()
    for kind, name in ((1, "ascii"), (2, "binary")):
        for order in (0, 1):
            writer = vtk.vtkPLYWriter()
            writer.SetInputData(data)
            writer.SetFileType(kind)
            writer.SetDataByteOrder(order)
            writer.SetFileName(place(f"ply_{name}_{order}", "ply"))
            writer.Write()
        writer = vtk.vtkSTLWriter()
        writer.SetInputData(data)
        writer.SetFileType(kind)
        writer.SetHeader("fault")
        writer.SetFileName(place(f"stl_{name}", "stl"))
        writer.Write()
    corners = [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]
    faces = [[data.GetCell(c).GetPointId(k) for k in range(3)] for c in range(data.GetNumberOfCells())]
    text = {
        "ts": "GOCAD TSurf 1\nHEADER {\nname:fault\n}\nTFACE\n"
              + "".join("VRTX %d %r %r %r\n" % (i + 1, *p) for i, p in enumerate(corners))
              + "".join("TRGL %d %d %d\n" % tuple(k + 1 for k in f) for f in faces) + "END\n",
        "obj": "o fault\n" + "".join("v %r %r %r\n" % p for p in corners)
               + "".join("f %d/1/1 %d//2 %d\n" % tuple(k + 1 for k in f) for f in faces),
        "off": "OFF # by hand\n%d %d 0\n" % (len(corners), len(faces)) + "".join("%r %r %r\n" % p for p in corners)
               + "".join("3 %d %d %d 255 0 0\n" % tuple(f) for f in faces),
        "dxf": "0\nSECTION\n2\nENTITIES\n" + "".join(
            "0\n3DFACE\n8\nfault\n" + "".join("%d\n%r\n" % (10 * (axis + 1) + k, corners[i][axis])
                                              for k, i in enumerate((*f, f[2])) for axis in range(3)) for f in faces)
               + "0\nENDSEC\n0\nEOF\n",
    }
    for extension, content in text.items():
        pathlib.Path(place(extension, extension)).write_text(content)


if __name__ == "__main__":
    main(sys.argv[1])
