# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids in: tables, cubes and OpenVDB into each other and into tiles, and a model's values onto them."""
import csv
import json
import math
import random
import subprocess
import unittest

from terratet import Case, twin_inputs
from test_tiles import Tileset

VDB_PYTHON = "/usr/bin/python3"  # Debian's python3-openvdb


def field(x, y, z):
    return x - 400000 + 2 * (y - 6700000) + 5 * z


class Grids(Case):
    size, origin, step = (70, 9, 11), (400005, 6700010, -95), (10, 20, 10)

    def table(self, name="t.csv", separator=";", shuffled=True):
        places = [tuple(o + s * n for o, s, n in zip(self.origin, self.step, (i, j, k)))
                  for i in range(self.size[0]) for j in range(self.size[1]) for k in range(self.size[2])]
        rows = [(x, y, z, field(x, y, z), ("clay", "sand")[z > -40], "" if x < 400050 else x / 7) for x, y, z in places]
        if shuffled:
            random.Random(4).shuffle(rows)
        self.write(name, separator.join("X Y Z value rock part".split()) + "\n" +
                   "".join(separator.join(map(str, row)) + "\n" for row in rows))
        return {row[:3]: row[3:] for row in rows}

    def rows(self, name):
        with open(self.folder / name, newline="") as file:
            return {tuple(float(row[a]) for a in "XYZ"): row for row in csv.DictReader(file)}

    def same(self, name, truth):
        rows = self.rows(name)
        self.assertEqual(rows.keys(), truth.keys())
        for place, (value, kind, part) in truth.items():
            row = rows[place]
            self.assertEqual(float(row["value"]), value)
            self.assertEqual(row["part"] == "", part == "")
            if part != "":
                self.assertAlmostEqual(float(row["part"]) / part, 1, 6)
            self.assertEqual(row["rock"], kind)

    def test_a_table_becomes_each_format_and_comes_back(self):
        truth = self.table()
        self.succeed("export", "t.csv,srs=EPSG:3067", "a.vdb", "a.nc", "a.tif", "a.csv", "a.json", "-q")
        self.same("a.csv", truth)
        for name in ("a.vdb", "a.nc", "a.tif"):
            self.succeed("export", name, "b.csv", "--overwrite", "-q")
            self.same("b.csv", truth)
            self.succeed("export", name, "b.json", "--overwrite", "-q")
            self.assertEqual(Tileset(self.folder / "b.json").document["extras"]["crs"][:9], "EPSG:3067")
        self.succeed("export", "a.nc", "c.vdb", "-q")
        self.succeed("export", "c.vdb", "c.nc", "-q")
        self.succeed("export", "c.nc", "c.csv", "-q")
        self.same("c.csv", truth)

    def test_tiles_of_a_linear_field_are_linear_up_to_their_faces(self):
        self.table()
        self.succeed("export", "t.csv,srs=EPSG:3067", "a.json", "-q")
        tileset = Tileset(self.folder / "a.json")
        self.assertEqual(tileset.levels, 2)
        self.assertEqual(list(tileset.properties), ["value", "part", "part_mask", "mask"])
        rock = Tileset(self.folder / "a" / "rock" / "tileset.json")
        self.assertEqual(rock.properties["rock"]["description"].count(";"), 1)
        seen = 0
        for tile in tileset.tiles(1):
            samples = tileset.samples(1, *tile)
            for at, value in samples["value"].items():
                n = [t * d + i for t, d, i in zip(tile, tileset.dimensions, at)]
                near = all(-1 <= i <= size for i, size in zip(n, self.size))
                x, y, z = (o + s * i for o, s, i in zip(self.origin, self.step, n))
                if near:  # one voxel beyond the grid too: what a viewer blends at its faces
                    seen += 1
                    self.assertAlmostEqual(value, field(x, y, z), 3)
                self.assertEqual(samples["mask"][at], 255 if all(0 <= i < m for i, m in zip(n, self.size)) else 0)
                if samples["mask"][at]:
                    self.assertEqual(samples["part_mask"][at], 255 if x >= 400050 else 0)
        self.assertGreater(seen, 70 * 9 * 11)

    def test_a_table_without_a_header_is_x_y_z_and_values(self):
        self.write("t.txt", "0 0 0 clay\n10 0 0 sand\n0 10 0 sand\n")
        self.succeed("export", "t.txt", "t.csv", "-q")
        self.assertEqual({p[:2]: row["value1"] for p, row in self.rows("t.csv").items()},
                         {(0, 0): "clay", (10, 0): "sand", (0, 10): "sand"})

    def test_what_is_no_grid_is_said(self):
        self.write("no.csv", "x,y,z,v\n0,0,0,1\n10,0,0,1\n13,0,0,1\n")
        self.fail_with(3, "export", "no.csv", "no.vdb", "-q", saying="evenly")
        self.write("no.csv", "a,b,c,v\n0,0,0,1\n")
        self.fail_with(3, "export", "no.csv", "no.vdb", "-q", saying="no x")
        self.write("no.csv", "x,y,z,v\n0,0,0,1\n0,here,0,1\n")
        self.fail_with(3, "export", "no.csv", "no.vdb", "-q", saying="line 3")
        self.write("no.csv", "x,y,z\n0,0,0\n")
        self.fail_with(3, "export", "no.csv", "no.vdb", "-q", saying="column of values")
        self.table()
        self.fail_with(2, "export", "t.csv", "t.vtu", "-q", saying="VTU")
        self.fail_with(2, "export", "t.csv", "t.vdb", "-tr", "5", "-q", saying="--voxel-size")
        self.write("no.vdb", "no")
        self.fail_with(3, "export", "no.vdb", "t.nc", "-q", saying="OpenVDB")
        self.write("no.nc", "no")
        self.fail_with(3, "export", "no.nc", "t.vdb", "-q", saying="no.nc")

    def test_a_place_that_has_a_value_twice_is_no_grids(self):
        self.write("no.csv", "x,y,z,v,w\n0,0,0,1,\n10,0,0,1,2\n0,0,0,,3\n10,0,0,,4\n")
        self.fail_with(3, "export", "no.csv", "no.vdb", "-q", saying="line 5: w has a value")

    def test_what_is_far_apart_in_openvdb_costs_only_what_is_there(self):
        program = """
import sys
import pyopenvdb
for name, far in ("wide", (70000, 70000, 0)), ("endless", (2 * 10**9, 2 * 10**9, -2 * 10**9)):
    grid = pyopenvdb.FloatGrid()
    grid.name = "K"
    grid.fill((0, 0, 0), (300, 40, 20), 3.0)  # tiles and leaves
    grid.getAccessor().setValueOn(far, 2.0)
    pyopenvdb.write(name + ".vdb", [grid])
"""
        subprocess.run([VDB_PYTHON, "-c", program], cwd=self.folder, check=True)
        self.fail_with(3, "export", "endless.vdb", "e.nc", "-q", saying="2000000001 x 2000000001 x 2000000021")
        self.fail_with(2, "export", "wide.vdb", "w.nc", "-q", saying="70001 × 70001 × 21 voxels")
        self.succeed("export", "wide.vdb", "w.vdb", "--allow-large", "-q")
        count = "import pyopenvdb; print(pyopenvdb.read('w.vdb', 'K').activeVoxelCount())"
        result = subprocess.run([VDB_PYTHON, "-c", count], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertEqual(int(result.stdout), 301 * 41 * 21 + 1)

    def test_a_models_values_at_the_places_of_a_grid_are_those_that_query_gives(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.write("g.csv", "x,y,z,v\n" + "".join(f"{x},{y},{z},0\n" for x in range(525200, 525800, 50)
                                                  for y in range(6791400, 6792400, 100) for z in (-800, -500, -200, 100)))
        self.succeed("export", "g.csv,srs=EPSG:3067", "g.nc", "g.tif", "-q")
        self.succeed("query", "m.gpkg", "value", "g.csv", "-o", "q.csv", "-q")
        with open(self.folder / "q.csv", newline="") as file:
            asked = {tuple(float(row[a]) for a in "xyz"): row for row in csv.DictReader(file)}
        for grid in ("g.csv", "g.nc", "g.tif"):
            self.succeed("resample", "m.gpkg", "--onto", grid, "r.csv", "r.nc", "--overwrite", "-q")
            rows = self.rows("r.csv")
            for place, row in rows.items():
                self.assertAlmostEqual(math.log10(float(row["K"])), math.log10(float(asked[place]["K"])), 5)
            inside = [p for p in asked if 6791500 <= p[1] <= 6792500 and p[2] <= 10]
            self.assertEqual(sorted(rows), sorted(inside))
        self.fail_with(2, "resample", "m.gpkg", "r.csv", saying="--onto")

    NODES = [(525400, 6791900, -300), (525600, 6791900, -300), (525600, 6792100, -300), (525400, 6792100, -300),
             (525400, 6791900, -100), (525600, 6791900, -100), (525600, 6792100, -100), (525400, 6792100, -100),
             (525500, 6792000, -50), (525500, 6792000, 9000)]
    VTU = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="10" NumberOfCells="2"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
{}
</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 4 5 6 7 8</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">8 13</DataArray><DataArray type="UInt8" Name="types" format="ascii">12 14
</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""
    MSH2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n{}\n$EndNodes\n$Elements\n2\n" \
           "1 5 2 1 1 1 2 3 4 5 6 7 8\n2 7 2 1 1 5 6 7 8 9\n$EndElements\n"

    def test_a_models_values_at_a_meshs_nodes_and_cells_are_those_that_query_gives(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg", "-q")
        lines = [" ".join(map(str, node)) for node in self.NODES]
        self.write("g.vtu", self.VTU.format("\n".join(lines)))
        self.write("g.msh", self.MSH2.format("\n".join(f"{i + 1} {line}" for i, line in enumerate(lines))))
        centers = [[sum(self.NODES[i][a] for i in cell) / len(cell) for a in range(3)]
                   for cell in (range(8), range(4, 9))]
        self.write("p.csv", "x,y,z\n" + "".join(",".join(map(str, p)) + "\n" for p in [*self.NODES, *centers]))
        asked = list(csv.DictReader(self.succeed("query", "m.gpkg", "value", "p.csv").stdout.splitlines()))
        for grid in ("g.vtu", "g.msh"):
            told = self.succeed("resample", "m.gpkg", "--onto", grid, "r.csv", "r.vtu", "--overwrite").stderr
            self.assertIn("10 nodes, 2 cells; 1 nodes lie beyond the model", told)
            with open(self.folder / "r.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([(row["of"], row["number"]) for row in rows],
                             [("node", str(i)) for i in range(10)] + [("cell", "0"), ("cell", "1")])
            beyond = rows[9], asked[9]  # the extent: a query answers there, a model has nothing
            self.assertEqual(beyond[0]["K"], "")
            pairs = [pair for pair in zip(rows, asked) if pair != beyond]
            self.assertEqual([row["K"] for row, _ in pairs], [row["K"] for _, row in pairs])
            self.assertEqual([row["extrapolation"] for row, _ in pairs], [row["K_extrapolation"] for _, row in pairs])
            self.vtk_reads("r.vtu", [float(row["K"] or "nan") for row in rows])

    def vtk_reads(self, name, values):
        """The mesh is the one that was given, with the values at its points and cells; where VTK is installed."""
        script = ("import sys, vtk, json; r = vtk.vtkXMLUnstructuredGridReader(); r.SetFileName(sys.argv[1]); r.Update();"
                  "g = r.GetOutput(); p, c = g.GetPointData().GetArray('K'), g.GetCellData().GetArray('K');"
                  "print(json.dumps([[g.GetCellType(i) for i in range(g.GetNumberOfCells())],"
                  "[g.GetPoint(i) for i in range(10)], [p.GetValue(i) for i in range(10)] + [c.GetValue(i) for i in range(2)]]))")
        if subprocess.run([VDB_PYTHON, "-c", "import vtk"], capture_output=True).returncode != 0:
            self.skipTest("VTK is not installed")
        done = subprocess.run([VDB_PYTHON, "-c", script, self.folder / name], capture_output=True, text=True, check=True)
        types, points, found = json.loads(done.stdout)
        self.assertEqual(types, [12, 14])
        self.assertEqual([tuple(p) for p in points], self.NODES)
        for a, b in zip(found, values):
            self.assertTrue(a == b or (math.isnan(a) and math.isnan(b)), (a, b))

    def test_meshes_that_gmsh_and_this_program_write_are_read_whole_and_damaged_ones_refused(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg", "-q")
        self.succeed("export", "m.gpkg", "o.vtu", "o.msh", "-q")
        for grid in ("o.vtu", "o.msh"):
            self.succeed("resample", "m.gpkg", "--onto", grid, "r.csv", "--overwrite", "-q")
            with open(self.folder / "r.csv", newline="") as file:
                cells = sum(row["of"] == "cell" for row in csv.DictReader(file))
            self.assertGreater(cells, 5000)
        lines = "\n".join(" ".join(map(str, node)) for node in self.NODES)
        good = self.VTU.format(lines)
        for bad, saying in ((good.replace("4 5 6 7 8<", "4 5 6 7 10<"), "names node 10, and there are 10"),
                            (good.replace("8 13", "8 14"), "do not suit"), (good.replace("12 14", "12"), "2 cells have 1 types"),
                            (good.replace("UnstructuredGrid\"", "ImageData\""), "ImageData"), ("", "not found, or empty")):
            self.fail_with(3, "resample", "m.gpkg", "--onto", self.write("b.vtu", bad), "q.csv", saying=saying)
        self.fail_with(3, "resample", "m.gpkg", "--onto", self.write("b.msh", "$MeshFormat\n4.1 1 8\n"), "q.csv", saying="binary")
        self.fail_with(2, "resample", "m.gpkg", "--onto", self.write("g.vtu", good), "q.nc", saying="becomes .vtu or .csv")

    def test_a_grid_in_another_system_is_asked_at_its_own_places(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.write("g.csv", "x,y,z,v\n" + "".join(f"{27.470 + 0.001 * i:.3f},{61.255 + 0.001 * j:.3f},{z},0\n"
                                                  for i in range(6) for j in range(6) for z in (-500, -300)))
        self.succeed("resample", "m.gpkg", "--onto", "g.csv,srs=EPSG:4326", "r.csv", "-q")
        self.succeed("query", "m.gpkg", "value", "g.csv", "-s_srs", "EPSG:4326", "-o", "q.csv", "-q")
        with open(self.folder / "q.csv", newline="") as file:
            asked = {tuple(round(float(row[a]), 4) for a in "xyz"): row for row in csv.DictReader(file)}
        rows = self.rows("r.csv")
        self.assertGreater(len(rows), 10)
        for place, row in rows.items():
            value = asked[tuple(round(c, 4) for c in place)]["K"]
            self.assertAlmostEqual(math.log10(float(row["K"])), math.log10(float(value)), 5)


if __name__ == "__main__":
    unittest.main()
