#!/usr/bin/python3
# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a mesh with split faults with VTK and checks it as a finite-element code would before it starts.

check_split.py FILE.vtu [--extent XMIN YMIN ZMIN XMAX YMAX ZMAX]

Every facet belongs to two cells that lie on opposite sides of it, or is on the box, or has exactly one twin: of other
nodes at the same three positions, seen from the other side. Volumes are positive and fill the box; regions meet at twins
alone; no two nodes are at one place but those of faults; what VTK takes for the surface is just that. Prints figures.
"""
import argparse
import collections
import json

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from check_vtu import read, tetrahedra, volumes

OUTWARD = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]


def parity(triples, order):
    """Of the permutation that sorts each row."""
    a, b, c = order.T
    return ((a > b) ^ (a > c) ^ (b > c)).astype(bool)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--extent", nargs=6, type=float)
    given = parser.parse_args()
    grid = read(given.file)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    cells = tetrahedra(grid)
    region = vtk_to_numpy(grid.GetCellData().GetArray("MaterialIDs"))
    in_extent = vtk_to_numpy(grid.GetCellData().GetArray("in_extent")) == 1
    assert (vtk_to_numpy(grid.GetCellData().GetArray("fault")) == -1).all(), "there are gap cells"
    assert (region[in_extent] >= 0).all(), "cells of no region"

    lo, hi = points.min(axis=0), points.max(axis=0)
    if given.extent:
        assert numpy.allclose([lo, hi], numpy.reshape(given.extent, (2, 3)), rtol=0, atol=1e-6), (lo, hi)
    volume = volumes(points, cells)
    assert (volume > 0).all(), f"{(volume <= 0).sum()} cells without volume"
    error = abs(volume.sum() / (hi - lo).prod() - 1)
    assert error < 1e-9, f"volumes do not fill the box: {error}"

    # Facets by nodes.
    facets = numpy.concatenate([cells[:, k] for k in OUTWARD])
    owner = numpy.tile(numpy.arange(len(cells)), 4)
    order = numpy.argsort(facets, axis=1)
    odd = parity(facets, order)
    sides = collections.defaultdict(list)
    for key, cell, turned in zip(map(tuple, numpy.sort(facets, axis=1)), owner, odd):
        sides[key].append((cell, turned))
    single = []
    for key, both in sides.items():
        assert len(both) <= 2, f"facet {key} has {len(both)} cells"
        if len(both) == 2:
            (c, c_odd), (d, d_odd) = both
            assert c_odd != d_odd, f"cells {c} and {d} lie on the same side of facet {key}"
            assert region[c] == region[d] or -1 in (region[c], region[d]), f"regions meet at facet {key}"
        else:
            single.append((key, *both[0]))

    # The others by positions.
    place = {position: number for number, position in enumerate(sorted(set(map(tuple, points))))}
    places = numpy.array([place[tuple(p)] for p in points])
    twins = collections.defaultdict(list)
    boundary = 0
    for key, cell, turned in single:
        corners = points[list(key)]
        if any((abs(corners[:, axis] - face[axis]) < 1e-6).all() for axis in range(3) for face in (lo, hi)):
            boundary += 1
            continue
        at = places[list(key)]
        sorting = numpy.argsort(at)
        odd_of_sorting = parity(None, sorting[None, :])[0]
        twins[tuple(at[sorting])].append((cell, turned ^ odd_of_sorting, key))
    for at, both in twins.items():
        assert len(both) == 2, f"facet of cell {both[0][0]} has {len(both) - 1} twins"
        (c, c_odd, c_key), (d, d_odd, d_key) = both
        assert c_odd != d_odd, f"twin facets of cells {c} and {d} are turned alike"
        assert c_key != d_key
    split = {node for both in twins.values() for _, _, key in both for node in key}
    per_place = collections.Counter(places)
    doubled = {node for node in range(len(points)) if per_place[places[node]] > 1}
    assert doubled <= split, f"{len(doubled - split)} nodes share a place off the faults"

    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.Update()
    shown = surface.GetOutput().GetNumberOfCells()
    assert shown == len(single), f"VTK finds {shown} facets of one cell, not {len(single)}"
    print(json.dumps({"cells": len(cells), "interior": len(sides) - len(single), "boundary": boundary,
                      "mirrored": len(twins), "places_split": sum(n > 1 for n in per_place.values()),
                      "most_nodes_at_a_place": max(per_place.values()), "regions": int(region.max()) + 1,
                      "least_volume": volume.min(), "volume_error": error}))


if __name__ == "__main__":
    main()
