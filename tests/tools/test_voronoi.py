# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Voronoi cells, meshes of simulators and surfaces as a user gets them, read by programs and parsers that are not ours."""
import collections
import math
import os
import sys
import unittest

try:
    import numpy as np
    from osgeo import ogr
except ImportError:  # Debian's Python has them, and its packages no other Python sees
    if sys.executable == "/usr/bin/python3":
        raise unittest.SkipTest("needs Debian's python3-gdal and python3-vtk9")
    os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B", *sys.argv])
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from terratet import EXTENT, Case, twin_inputs

LOW, HIGH = np.array([float(x) for x in EXTENT.split(",")]).reshape(2, 3)
VOLUME = np.prod(HIGH - LOW)


def read_vtu(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def polyhedra(grid):
    """Each cell's faces, lists of points."""
    for c in range(grid.GetNumberOfCells()):
        stream = vtkIdList()
        grid.GetFaceStream(c, stream)
        numbers = [stream.GetId(i) for i in range(stream.GetNumberOfIds())]
        faces, at = [], 1
        for _ in range(numbers[0]):
            faces.append(numbers[at + 1:at + 1 + numbers[at]])
            at += 1 + numbers[at]
        yield faces


def read_uge(path):
    lines = path.read_text().splitlines()
    kind, count = lines[0].split()
    assert kind == "CELLS"
    cells = np.array([line.split() for line in lines[1:1 + int(count)]], float)
    kind, connections = lines[1 + int(count)].split()
    assert kind == "CONNECTIONS"
    rest = np.array([line.split() for line in lines[2 + int(count):]], float)
    assert len(rest) == int(connections) and (cells[:, 0] == np.arange(1, len(cells) + 1)).all()
    return cells[:, 1:4], cells[:, 4], rest[:, :2].astype(int) - 1, rest[:, 2:5], rest[:, 5]


class Voronoi(Case):
    def model(self, *arguments):
        self.succeed("build", *twin_inputs(), *arguments, "-o", "m.gpkg")

    def test_polyhedra_fill_the_extent_and_have_their_volumes(self):
        for mode in ("paired", "exact"):
            self.model("--fault-mode", mode, "--overwrite")
            self.succeed("export", "m.gpkg", "v.vtu", "--voronoi", "--overwrite")
            grid = read_vtu(self.folder / "v.vtu")
            points = vtk_to_numpy(grid.GetPoints().GetData()) - (LOW + HIGH) / 2
            volume = vtk_to_numpy(grid.GetCellData().GetArray("volume"))
            area = vtk_to_numpy(grid.GetCellData().GetArray("area"))
            self.assertAlmostEqual(volume.sum() / VOLUME, 1, delta=1e-9)
            self.assertTrue((volume > 0).all())
            owners = collections.Counter()
            for c, faces in enumerate(polyhedra(grid)):
                around = points[faces[0][0]]
                cones = surface = 0
                for face in faces:
                    p = points[face] - around
                    normal = sum(np.cross(p[i] - p[0], p[i + 1] - p[0]) for i in range(1, len(p) - 1)) / 2
                    cones += p[0] @ normal / 3
                    surface += np.linalg.norm(normal)
                    owners[tuple(sorted(face))] += 1
                self.assertAlmostEqual(cones / volume[c], 1, delta=1e-5)
                self.assertAlmostEqual(surface / area[c], 1, delta=1e-6)
            self.assertLessEqual(max(owners.values()), 2)  # cells share their walls, points and all
            region = vtk_to_numpy(grid.GetCellData().GetArray("MaterialIDs"))
            self.assertGreaterEqual(region.min(), 0)
            self.assertGreater(len(vtk_to_numpy(grid.GetCellData().GetArray("K"))), 500)

    def test_the_model_ends_at_the_ground(self):
        self.write("ground.csv", "x,y,z\n" + "".join(f"{x},{y},{-60 - 0.05 * (x - 525130)}\n" for x in range(525030, 526000, 100)
                                                  for y in range(6791400, 6792700, 100)))
        self.model("--topography", "ground.csv")
        self.succeed("export", "m.gpkg", "v.vtu", "v.uge", "--voronoi")
        volume = vtk_to_numpy(read_vtu(self.folder / "v.vtu").GetCellData().GetArray("volume")).sum()
        below = 740 * 1000 * (990 - 60 - 0.05 * 370)
        self.assertAlmostEqual(volume / below, 1, delta=2e-3)
        self.assertAlmostEqual(read_uge(self.folder / "v.uge")[1].sum() / volume, 1, delta=1e-12)
        area = sum(float(line.split()[4]) for line in (self.folder / "v" / "ground.ex").read_text().splitlines()[1:])
        self.assertAlmostEqual(area / (740 * 1000 * math.hypot(1, 0.05)), 1, delta=0.02)

    def test_control_volumes_carry_a_linear_pressure_exactly(self):
        self.model("--fault-mode", "exact")
        self.succeed("export", "m.gpkg", "v.uge")
        centres, volumes, pairs, places, areas = read_uge(self.folder / "v.uge")
        self.assertAlmostEqual(volumes.sum() / VOLUME, 1, delta=1e-9)
        ends = centres[pairs]
        self.assertLess(np.abs(places - ends.mean(axis=1)).max(), 1e-6)
        gradient = np.array([0.3, -0.2, 0.7])
        flux = areas * ((ends[:, 1] - ends[:, 0]) @ gradient) / np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        balance = np.zeros(len(centres))
        np.add.at(balance, pairs[:, 0], flux)
        np.add.at(balance, pairs[:, 1], -flux)
        outer = np.zeros(len(centres), bool)
        for side in ("west", "east", "south", "north", "bottom", "top"):
            rows = np.array([line.split() for line in (self.folder / "v" / f"{side}.ex").read_text().splitlines()[1:]], float)
            axis = ("west", "south", "bottom").index(side) if side in ("west", "south", "bottom") else \
                ("east", "north", "top").index(side)
            normal = np.zeros(3)
            normal[axis] = -1 if side in ("west", "south", "bottom") else 1
            cells = rows[:, 0].astype(int) - 1
            np.add.at(balance, cells, rows[:, 4] * (normal @ gradient))
            outer[cells] = True
            self.assertAlmostEqual(rows[:, 4].sum() / np.prod(np.delete(HIGH - LOW, axis)), 1, delta=1e-9)
        self.assertGreater((~outer).sum(), 100)
        self.assertLess(np.abs(balance).max(), 1e-6 * areas.max())  # what flows in flows out, in every cell
        across = np.array([line.split() for line in next((self.folder / "v").glob("*.pairs")).read_text().splitlines()], int) - 1
        connected = {tuple(pair) for pair in pairs}
        self.assertTrue(all(tuple(pair) in connected for pair in across))
        self.assertGreater(len(across), 100)

    def test_tetrahedra_of_pflotran_fill_the_extent(self):
        self.model()
        self.succeed("export", "m.gpkg", "t.ugi", "--fault-gap", "collapse")
        lines = (self.folder / "t.ugi").read_text().splitlines()
        cells, points = map(int, lines[0].split())
        self.assertEqual({line.split()[0] for line in lines[1:1 + cells]}, {"T"})
        corners = np.array([line.split()[1:] for line in lines[1:1 + cells]], int) - 1
        places = np.array([line.split() for line in lines[1 + cells:]], float) - LOW
        self.assertEqual(len(places), points)
        p = places[corners]
        volumes = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
        self.assertTrue((volumes > 0).all())
        self.assertAlmostEqual(volumes.sum() / VOLUME, 1, delta=1e-9)
        top = (self.folder / "t" / "top.ss").read_text().splitlines()
        self.assertEqual(len(top), 1 + int(top[0]))
        facets = np.array([line.split()[1:] for line in top[1:]], int) - 1
        self.assertTrue(np.allclose(places[facets][:, :, 2], HIGH[2] - LOW[2]))
        numbered = sum(len(path.read_text().split()) for path in (self.folder / "t").glob("*.txt"))
        self.assertEqual(numbered, cells)

    def test_submeshes_of_opengeosys_name_what_they_are_of_the_bulk(self):
        for gap in ("keep", "collapse"):
            self.model("--overwrite")
            self.succeed("export", "m.gpkg", "o.vtu,of=OGS", "--fault-gap", gap, "--overwrite")
            bulk = read_vtu(self.folder / "o.vtu")
            points = vtk_to_numpy(bulk.GetPoints().GetData())
            self.assertGreaterEqual(vtk_to_numpy(bulk.GetCellData().GetArray("MaterialIDs")).min(), 0)
            names = {path.stem for path in (self.folder / "o").glob("*.vtu")}
            self.assertTrue({"west", "east", "south", "north", "bottom", "top"} < names, names)
            for name in names:
                part = read_vtu(self.folder / "o" / f"{name}.vtu")
                nodes = vtk_to_numpy(part.GetPointData().GetArray("bulk_node_ids"))
                cells = vtk_to_numpy(part.GetCellData().GetArray("bulk_element_ids"))
                self.assertEqual((nodes.dtype, cells.dtype), (np.uint64, np.uint64))
                self.assertTrue((points[nodes.astype(int)] == vtk_to_numpy(part.GetPoints().GetData())).all())
                for c in range(part.GetNumberOfCells()):
                    of_bulk = bulk.GetCell(int(cells[c])).GetPointIds()
                    corners = {of_bulk.GetId(k) for k in range(4)}
                    ids = part.GetCell(c).GetPointIds()
                    self.assertTrue({int(nodes[ids.GetId(k)]) for k in range(3)} < corners)
            self.assertIn(f"cells       {bulk.GetNumberOfCells()}", self.succeed("info", "o.vtu").stdout)


def read_tsurf(text):
    """By GOCAD's description: objects of parts, with vertices by their ids."""
    objects, name = {}, None
    for line in text.splitlines():
        words = line.split()
        if line.startswith("name:"):
            name = line[5:].strip()
            objects[name] = []
        elif words[0] == "TFACE":
            objects[name].append(({}, []))
        elif words[0] == "VRTX":
            objects[name][-1][0][int(words[1])] = tuple(map(float, words[2:]))
        elif words[0] == "TRGL":
            objects[name][-1][1].append(tuple(map(int, words[1:])))
    return objects


def area(triangles):
    p = np.array(triangles)
    return np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2


class Surfaces(Case):
    def test_barriers_and_isosurfaces_come_back_the_same_in_every_format(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        for name in ("s.ts", "s.obj", "s.gpkg,of=SURFACES"):
            self.succeed("export", "m.gpkg", name, "--iso", "K=5e-11", "--overwrite")
        parts = read_tsurf((self.folder / "s.ts").read_text())
        self.assertEqual(set(parts), {"fracture", "K=5e-11"})
        areas = {name: sum(area([[v[i] for i in t] for t in triangles]) for v, triangles in faces)
                 for name, faces in parts.items()}
        layer = ogr.Open(str(self.folder / "s.gpkg"))
        for feature in layer.GetLayer(0):
            tin = feature.GetGeometryRef()
            self.assertEqual(tin.GetGeometryName(), "TIN")
            triangles = [[tin.GetGeometryRef(i).GetGeometryRef(0).GetPoint(k) for k in range(3)]
                         for i in range(tin.GetGeometryCount())]
            self.assertAlmostEqual(area(triangles) / areas[feature["name"]], 1, delta=1e-9)
            self.assertAlmostEqual(feature["area"] / areas[feature["name"]], 1, delta=1e-9)
        objects = collections.defaultdict(list)
        vertices = []
        for line in (self.folder / "s.obj").read_text().splitlines():
            key, _, rest = line.partition(" ")
            if key == "o":
                name = rest
            elif key == "v":
                vertices.append(tuple(map(float, rest.split())))
            else:
                objects[name].append([vertices[int(i) - 1] for i in rest.split()])
        self.assertEqual({name: round(area(t), 3) for name, t in objects.items()},
                         {name: round(a, 3) for name, a in areas.items()})
        for name in ("s.ts", "s.obj", "s.gpkg"):  # and our own reader
            inputs = twin_inputs(faults="none")
            inputs[inputs.index("--faults") + 1] = self.folder / name
            self.succeed("build", *inputs, "-o", "again.gpkg", "--overwrite", "--report", "r.json")

    def test_a_fault_without_width_keeps_its_split_nodes(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "whole.ts", "split.ts", "--iso", "K=5e-11", "--overwrite")
        self.succeed("export", "m.gpkg", "split.ts", "--iso", "K=5e-11", "--fault-gap", "collapse", "--overwrite")
        whole = read_tsurf((self.folder / "whole.ts").read_text())
        split = read_tsurf((self.folder / "split.ts").read_text())
        fault = next(name for name in whole if not name.startswith("K="))
        self.assertEqual(len(whole[fault]), 1)
        self.assertEqual(len(split[fault]), 2)
        (one, one_triangles), (other, other_triangles) = split[fault]
        self.assertFalse(set(one) & set(other))  # nodes of their own …
        places = [sorted(sorted(v[i] for i in t) for t in triangles) for v, triangles in split[fault]]
        self.assertEqual(*places)  # … in the same places
        self.assertGreater(len(one_triangles), 100)


if __name__ == "__main__":
    unittest.main()
