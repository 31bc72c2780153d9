#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads Gmsh files as the format's specification says ("MSH file format", gmsh.info) and with Gmsh itself where there is
one: volumes by physical group are those of the blocks in a VTU file, the six sides have the extent's areas.

check_msh.py CLIPPED.vtu FILE.msh...
"""
import shutil
import subprocess
import sys
import tempfile

import numpy
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, strings, tetrahedra, volumes


def sections(path):
    found, name = {}, None
    for line in open(path):
        line = line.rstrip("\n")
        if line.startswith("$End"):
            name = None
        elif line.startswith("$"):
            name = line[1:]
            found[name] = []
        else:
            found[name].append(line)
    return found


def version_2(parts):
    nodes = {int(w[0]): [float(x) for x in w[1:]] for w in map(str.split, parts["Nodes"][1:])}
    assert len(nodes) == int(parts["Nodes"][0])
    elements = [[int(w) for w in line.split()] for line in parts["Elements"][1:]]
    assert len(elements) == int(parts["Elements"][0])
    return nodes, [(3 if e[1] == 4 else 2, e[3], e[3 + e[2]:]) for e in elements]


def version_4(parts):
    points, curves, surfaces, solids = map(int, parts["Entities"][0].split())
    assert points == curves == 0 and len(parts["Entities"]) == 1 + surfaces + solids
    physical = {}
    for n, line in enumerate(parts["Entities"][1:]):
        words = line.split()
        assert int(words[7]) == 1
        physical[2 if n < surfaces else 3, int(words[0])] = int(words[8])
    lines = iter(parts["Nodes"])
    blocks, count, _, _ = map(int, next(lines).split())
    nodes = {}
    for _ in range(blocks):
        *_, size = map(int, next(lines).split())
        tags = [int(next(lines)) for _ in range(size)]
        nodes.update((tag, [float(x) for x in next(lines).split()]) for tag in tags)
    assert len(nodes) == count
    lines = iter(parts["Elements"])
    blocks, count, _, _ = map(int, next(lines).split())
    elements = []
    for _ in range(blocks):
        dimension, tag, kind, size = map(int, next(lines).split())
        assert kind == {2: 2, 3: 4}[dimension]
        elements += [(dimension, physical[dimension, tag], [int(w) for w in next(lines).split()][1:]) for _ in range(size)]
    assert len(elements) == count
    return nodes, elements


def main():
    grid = read(sys.argv[1])
    region = vtk_to_numpy(grid.GetCellData().GetArray("MaterialIDs"))
    size = volumes(vtk_to_numpy(grid.GetPoints().GetData()), tetrahedra(grid))
    bounds = numpy.array(grid.GetBounds()).reshape(3, 2)
    side = numpy.diff(bounds).ravel()
    areas = {"west": side[1] * side[2], "east": side[1] * side[2], "south": side[0] * side[2], "north": side[0] * side[2],
             "bottom": side[0] * side[1], "top": side[0] * side[1]}
    for path in sys.argv[2:]:
        parts = sections(path)
        version = parts["MeshFormat"][0].split()[0]
        nodes, elements = (version_4 if version == "4.1" else version_2)(parts)
        names = {}
        for line in parts["PhysicalNames"][1:]:
            dimension, tag, name = line.split(" ", 2)
            names[int(dimension), int(tag)] = name.strip('"')
        measure = {}
        for dimension, tag, corners in elements:
            p = numpy.array([nodes[c] for c in corners])
            cross = numpy.cross(p[1] - p[0], p[2] - p[0])
            part = cross @ (p[3] - p[0]) / 6 if dimension == 3 else numpy.linalg.norm(cross) / 2
            assert part > 0, f"{path}: an element turned inside out"
            name = names[dimension, tag]
            measure[name] = measure.get(name, 0) + part
        for number, name in enumerate(strings(grid, "Regions")):
            assert abs(measure[name] / size[region == number].sum() - 1) < 1e-9, f"{path}: volume of {name}"
        for name, area in areas.items():
            assert abs(measure[name] / area - 1) < 1e-9, f"{path}: area of {name} is {measure[name]}, not {area}"
        faults = [name for (dimension, _), name in names.items() if dimension == 2 and name not in areas]
        assert faults == [name.replace('"', "'") for name in strings(grid, "Faults")], f"{path}: faults {faults}"
        if shutil.which("gmsh"):
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(["gmsh", path, "-0", "-o", folder + "/again.msh", "-format", "msh41", "-v", "4"],
                                      capture_output=True, text=True)
            said = done.stdout + done.stderr
            assert done.returncode == 0 and "Error" not in said, f"{path}: Gmsh says {said}"
            assert f"{len(nodes)} nodes" in said, said
        print(f"{path}: version {version}, {len(nodes)} nodes, {len(elements)} elements, groups {sorted(measure)}")


if __name__ == "__main__":
    try:
        main()
    except AssertionError as error:
        sys.exit(f"check_msh.py: {error}")
