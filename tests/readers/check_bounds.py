#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does a model end at its domain's polygon, and below its ground? Read with VTK and OpenVDB, and glTF by hand.

check_bounds.py [--domain RINGS.json] [--ground GROUND.asc] [--tolerance T] [--height H] FILE...

RINGS.json is a list of rings, a ring a list of [x, y]; a place is inside by the even-odd rule. Prints one JSON object.
"""
import argparse
import json
import struct

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from check_ground import ground_of, outer_facets
from check_vtu import read, tetrahedra, volumes
from vdb_grids import float_grids


class Polygon:
    def __init__(self, rings):
        self.edges = numpy.array([(a, b) for ring in rings for a, b in zip(ring, ring[1:] + ring[:1])])
        self.area = abs(sum(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2 for ring in rings))
        self.perimeter = numpy.linalg.norm(self.edges[:, 1] - self.edges[:, 0], axis=1).sum()

    def distance(self, p):
        """Of each place to each edge."""
        a, d = self.edges[:, 0], self.edges[:, 1] - self.edges[:, 0]
        t = numpy.clip(((p[:, None, :2] - a) * d).sum(axis=2) / (d * d).sum(axis=1), 0, 1)
        return numpy.linalg.norm(p[:, None, :2] - a - t[:, :, None] * d, axis=2)

    def outside(self, p):
        """How far each place is outside; 0 inside."""
        result = numpy.zeros(len(p))
        for begin in range(0, len(p), 20000):
            q = p[begin:begin + 20000]
            inside = numpy.zeros(len(q), bool)
            for a, b in self.edges:
                straddles = (a[1] > q[:, 1]) != (b[1] > q[:, 1])
                with numpy.errstate(divide="ignore", invalid="ignore"):
                    inside ^= straddles & (q[:, 0] < (b[0] - a[0]) * (q[:, 1] - a[1]) / (b[1] - a[1]) + a[0])
            result[begin:begin + 20000] = numpy.where(inside, 0, self.distance(q).min(axis=1))
        return result


def glb_meshes(path):
    """Name, places in true coordinates, triangles of each mesh."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version, _ = struct.unpack_from("<4sII", data)
    assert magic == b"glTF" and version == 2
    length, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    scene = json.loads(data[20:20 + length])
    binary = data[20 + length + 8:]
    extras = scene["asset"]["extras"]
    origin = numpy.array(extras["origin"], float)
    unit = extras.get("metres_per_unit", 1)

    def array(index):
        accessor = scene["accessors"][index]
        view = scene["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        assert "byteStride" not in view or view["byteStride"] == width * numpy.dtype(kind).itemsize
        return numpy.frombuffer(binary, kind, accessor["count"] * width, begin).reshape(-1, width)

    for node in scene["nodes"]:
        if "mesh" not in node:
            continue
        assert not {"matrix", "translation", "rotation", "scale"} & set(node), "a node that is moved"
        for primitive in scene["meshes"][node["mesh"]]["primitives"]:
            p = array(primitive["attributes"]["POSITION"]).astype(float)
            places = numpy.column_stack([p[:, 0], -p[:, 2], p[:, 1]]) / unit + origin
            if primitive.get("mode", 4) != 4:
                continue  # the frame's lines
            triangles = array(primitive["indices"]).reshape(-1, 3) if "indices" in primitive else None
            yield node.get("name", ""), places, triangles


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--domain")
    parser.add_argument("--ground")
    parser.add_argument("--tolerance", type=float, default=2, help="where other surfaces meet a wall or the ground")
    parser.add_argument("--strays", type=float, default=0.03, help="share of places that may be outside at all")
    parser.add_argument("--height", type=float, help="of the model: volume and walls are as of the polygon times it")
    parser.add_argument("files", nargs="+")
    args = parser.parse_args()
    polygon = Polygon(json.load(open(args.domain))) if args.domain else None
    ground = ground_of(args.ground) if args.ground else None
    result = {}

    def check(what, places):
        if polygon:
            outside = polygon.outside(places)
            over = outside.max()
            result[what + " outside"] = over
            result[what + " strays"] = int((outside > 1e-3).sum())
            assert (outside > 0.01).mean() <= args.strays, f"{what}: {(outside > 0.01).mean():.2%} of {len(outside)} places are outside, by up to {outside.max():.3g}"
            assert over < args.tolerance, f"{what}: {over} outside the domain"
        if ground:
            over = (places[:, 2] - ground(places)).max()
            result[what + " above"] = over
            assert over < args.tolerance, f"{what}: {over} above the ground"

    for path in args.files:
        if path.endswith(".vtu"):
            grid = read(path)
            points = vtk_to_numpy(grid.GetPoints().GetData())
            cells = tetrahedra(grid)
            size = volumes(points, cells)
            assert (size > 0).all(), "cells turned inside out"
            inside = vtk_to_numpy(grid.GetCellData().GetArray("in_extent")) == 1
            check(path, points[numpy.unique(cells[inside])])
            result[path + " volume"] = size[inside].sum()
            if args.height and polygon:
                expected = polygon.area * args.height
                assert abs(size[inside].sum() / expected - 1) < 0.005, f"volume {size[inside].sum()}, not {expected}"
                walls = wall_area(grid, polygon)
                result[path + " walls"] = walls
                assert abs(walls / (polygon.perimeter * args.height) - 1) < max(0.001, args.strays), f"walls {walls}, not {polygon.perimeter * args.height}"
        elif path.endswith(".vdb"):
            for name, grid in float_grids(path).items():
                indices = [item.min for item in grid.iterOnValues()]
                places = numpy.array([grid.transform.indexToWorld(tuple(map(int, index))) for index in indices])
                check(f"{path} {name}", places)
                result[f"{path} {name} voxels"] = len(places)
                if args.height and polygon:
                    filled = len(places) * numpy.prod(grid.transform.voxelSize())
                    assert abs(filled / (polygon.area * args.height) - 1) < 0.02, f"voxels fill {filled}"
        else:
            kinds = {}  # sections alone have too few places for a share of them to mean anything
            for name, places, triangles in glb_meshes(path):
                if name.startswith(("section", "ground", "region", "layer", "isosurface", "fault", "horizon")):
                    used = places if triangles is None else places[numpy.unique(triangles)]
                    kinds.setdefault("ground" if name == "ground" else "scene", []).append(used)
            for kind, places in kinds.items():
                check(f"{path} {kind}", numpy.concatenate(places))
            assert kinds, "no mesh to check"
    print(json.dumps(result))


def wall_area(grid, polygon):
    """Of the facets of cells inside that lie on an edge of the polygon."""
    a, b, c = outer_facets(grid)
    near = numpy.max([polygon.distance(p) for p in (a, b, c)], axis=0).min(axis=1) < 1e-3
    return (numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2)[near].sum()


if __name__ == "__main__":
    main()
