# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The extrapolation as programs read it that mask by it."""
import csv
import json
import math
import random
import re
import struct
import unittest

from terratet import Case


def read_glb(path):
    """The document and its binary chunk."""
    content = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack_from("<I4s", content, 12)
    assert kind == b"JSON"
    return json.loads(content[20:20 + size]), content[20 + size + 8:]


def read_floats(document, binary, accessor):
    """Tuples of one accessor, which is packed."""
    accessor = document["accessors"][accessor]
    assert accessor["componentType"] == 5126  # float
    width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
    view = document["bufferViews"][accessor["bufferView"]]
    assert view.get("byteStride", 4 * width) == 4 * width
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return list(struct.iter_unpack(f"<{width}f", binary[begin:begin + 4 * width * accessor["count"]]))


class Extrapolation(Case):
    def test_the_distance_to_the_samples_over_twice_the_reach_and_sections_between_the_vertices(self):
        random.seed(5)
        samples = [(random.uniform(0, 400), random.uniform(0, 400), random.uniform(-200, 0)) for _ in range(60)]
        samples = [tuple(round(c, 3) for c in p) for p in samples]
        (self.folder / "s.csv").write_text("x,y,z,K\n" + "".join(
            f"{x + 500000},{y + 6700000},{z},{random.random():.4f}\n" for x, y, z in samples))
        self.succeed("convert", "--samples", "s.csv", "-s_srs", "EPSG:3067", "--property", "K",
                     "-te", *"499100,6699100,-600,501300,6701300,300".split(","), "--lmin", "60m", "--lmax", "200m",
                     "--estimator", "idw", "m.gpkg", "m.glb", "m.csv")
        estimator = json.loads(self.succeed("info", "--json", "m.gpkg").stdout)["estimator"]
        [reach] = [float(a) for a in re.findall(r"^samples:.*:reach=(\S+) of K$", estimator, re.MULTILINE)]
        self.assertGreater(reach, 100)

        def expected(place):
            return min(1, min(math.dist(place, p) for p in samples) / (2 * reach))

        with open(self.folder / "m.csv") as file:
            for row in csv.DictReader(file):
                place = float(row["x"]) - 500000, float(row["y"]) - 6700000, float(row["z"])
                self.assertAlmostEqual(float(row["extrapolation"]), expected(place), delta=1e-9)
        document, binary = read_glb(self.folder / "m.glb")
        origin = document["asset"]["extras"]["origin"]
        seen, errors = [], []
        for mesh in document["meshes"]:
            for primitive in mesh["primitives"]:
                attributes = primitive["attributes"]
                if "_K" not in attributes:
                    continue
                places = read_floats(document, binary, attributes["POSITION"])
                values = read_floats(document, binary, attributes["_EXTRAPOLATION"])
                self.assertEqual(len(places), len(values))
                for (x, up, south), (value,) in zip(places, values):
                    place = x + origin[0] - 500000, -south + origin[1] - 6700000, up + origin[2]
                    # Linear along the cells' edges, whose ends are exact.
                    self.assertAlmostEqual(value, expected(place), delta=0.1)
                    seen.append(value)
                    errors.append(abs(value - expected(place)))
        self.assertGreater(len(seen), 500)
        self.assertLess(min(seen), 0.9)
        self.assertEqual(max(seen), 1)
        self.assertLess(sum(errors) / len(errors), 0.01)


if __name__ == "__main__":
    unittest.main()
