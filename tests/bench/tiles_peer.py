# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A straightforward tiler to compare with: an X;Y;Z;value table into the same voxel tiles, with numpy.

  tiles_peer.py TABLE FOLDER"""
import json
import pathlib
import struct
import sys

import numpy as np

table, folder = sys.argv[1], pathlib.Path(sys.argv[2])
rows = np.genfromtxt(table, delimiter=";", skip_header=1)
axes = [np.unique(rows[:, a]) for a in range(3)]
cube = np.full([len(a) for a in axes], np.nan, np.float32)
cube[tuple(np.searchsorted(a, rows[:, n]) for n, a in enumerate(axes))] = rows[:, 3]

levels = [cube]
while max(levels[-1].shape) > 64:
    fine = levels[-1]
    fine = np.pad(fine, [(0, n % 2) for n in fine.shape], constant_values=np.nan)
    eight = np.stack([fine[i::2, j::2, k::2] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    count = np.sum(~np.isnan(eight), axis=0)
    with np.errstate(invalid="ignore"):
        levels.append((np.nansum(eight, axis=0) / count).astype(np.float32))
levels.reverse()
dims = [2 * -(-n // 2**len(levels)) if len(levels) > 1 else n for n in cube.shape]


def glb(tile):
    """Padded samples in the order x, up, south."""
    mask = ~np.isnan(tile)
    filled = tile.copy()
    for axis in range(3):
        for _ in range(tile.shape[axis]):
            empty = np.isnan(filled)
            if not empty.any():
                break
            for way in (1, -1):
                moved = np.roll(filled, way, axis)
                filled = np.where(np.isnan(filled), moved, filled)
    values = filled[:, ::-1].transpose(1, 2, 0).astype("<f4").tobytes()
    bytes_ = np.zeros((mask.size, 4), np.uint8)
    bytes_[:, 0] = 255 * mask[:, ::-1].transpose(1, 2, 0).ravel()
    body = values + bytes_.tobytes()
    text = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(body)}]}).encode()
    text += b" " * (-len(text) % 4)
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(body)) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(body), b"BIN\0") + body)


folder.mkdir(parents=True, exist_ok=True)
for level, values in enumerate(levels):
    padded = np.pad(values, [(1, d * 2**level - n + 1) for d, n in zip(dims, values.shape)], constant_values=np.nan)
    for x in range(2**level):
        for y in range(2**level):
            for z in range(2**level):
                tile = padded[tuple(slice(t * d, (t + 1) * d + 2) for t, d in zip((x, y, z), dims))]
                if not np.isnan(tile).all():
                    (folder / f"{level}_{x}_{y}_{z}.glb").write_bytes(glb(tile))
