# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tilesets read by the specification: where each sample lies, what it is worth, which tiles there are."""
import array
import csv
import json
import math
import struct
import unittest

from terratet import Case, twin_inputs


def read_glb(path):
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def read_subtree(path):
    """Which tiles of each level there are, by x, y, z."""
    data = path.read_bytes()
    magic, version, text, _ = struct.unpack_from("<4sIQQ", data)
    assert (magic, version, text % 8) == (b"subt", 1, 0)
    document, body = json.loads(data[24:24 + text]), data[24 + text:]
    return document, body


def available(document, body, key, count):
    entry = document[key]
    if "constant" in entry:
        return [entry["constant"] == 1] * count
    view = document["bufferViews"][entry["bitstream"]]
    assert view["byteLength"] == (count + 7) // 8
    bits = [body[view["byteOffset"] + n // 8] >> n % 8 & 1 == 1 for n in range(count)]
    assert sum(bits) == entry["availableCount"]
    return bits


class Tileset:
    """By the rules of 3DTILES_content_voxels for boxes."""
    def __init__(self, path):
        self.folder = path.parent
        self.document = json.loads(path.read_text())
        self.content = self.document["root"]["content"]
        voxels = self.content["extensions"]["3DTILES_content_voxels"]
        self.dimensions = voxels["dimensions"]
        self.properties = self.document["schema"]["classes"]["voxel"]["properties"]
        self.levels = self.document["root"]["implicitTiling"]["availableLevels"]

    def path(self, level, x, y, z):
        return self.folder / self.content["uri"].format(level=level, x=x, y=y, z=z)

    def tiles(self, level):
        return [(x, y, z) for x in range(2**level) for y in range(2**level) for z in range(2**level)
                if self.path(level, x, y, z).exists()]

    def samples(self, level, x, y, z):
        """By property: (i, j, k) from −1 to dimension, padding included → value; bytes as they are."""
        document, body = read_glb(self.path(level, x, y, z))
        primitive = document["meshes"][0]["primitives"][0]
        extension = primitive["extensions"]["EXT_primitive_voxels"]
        dx, dy, dz = self.dimensions
        assert extension["dimensions"] == [dx, dz, dy], extension
        result = {}
        names = document["extensions"]["EXT_structural_metadata"]["propertyAttributes"][0]["properties"]
        assert list(names) == list(self.properties) and len(names) == len(primitive["attributes"])
        for name, property_attribute in names.items():
            accessor = document["accessors"][primitive["attributes"][property_attribute["attribute"]]]
            view = document["bufferViews"][accessor["bufferView"]]
            raw = body[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
            floats = accessor["componentType"] == 5126
            assert self.properties[name]["componentType"] == ("FLOAT32" if floats else "UINT8")
            values = array.array("f", raw) if floats else raw[::view["byteStride"]]
            assert len(values) == accessor["count"] == (dx + 2) * (dy + 2) * (dz + 2)
            result[name] = {(i, j, k): values[(i + 1) + (dx + 2) * ((k + 1) + (dz + 2) * (dy - j))]
                            for i in range(-1, dx + 1) for j in range(-1, dy + 1) for k in range(-1, dz + 1)}
        return result


class Tiles(Case):
    def test_each_sample_of_the_finest_level_is_the_block_models(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "out/tileset.json", "b.csv,of=BLOCKS", "--voxels", "-tr", "12,10,11", "-q")
        with open(self.folder / "b.csv", newline="") as file:
            blocks = {tuple(float(row[a]) for a in "XYZ"): row for row in csv.DictReader(file)}
        tileset = Tileset(self.folder / "out" / "tileset.json")
        regions = Tileset(self.folder / "out" / "tileset" / "region" / "tileset.json")
        self.succeed("export", "m.gpkg", "out/tileset.json", "--voxels", "--overwrite", "-tr", "12,10,11", "-q")
        extras = tileset.document["extras"]
        self.assertEqual(extras["tilesets"], [{"property": "region", "uri": "tileset/region/tileset.json"}])
        finest, found, beyond = tileset.levels - 1, 0, 0
        self.assertEqual(tileset.tiles(finest), regions.tiles(finest))
        for tile in tileset.tiles(finest):
            samples, of_regions = tileset.samples(finest, *tile), regions.samples(finest, *tile)
            for (i, j, k), value in samples["K_log10"].items():
                place = tuple(o + s * (t * d + n) for o, s, t, d, n in
                              zip(extras["origin"], extras["spacing"], tile, tileset.dimensions, (i, j, k)))
                row = blocks.get(place)
                self.assertEqual(samples["mask"][i, j, k], 255 if row else 0)
                if row:
                    found += 1
                    self.assertAlmostEqual(value, math.log10(float(row["K"])), 5)
                    self.assertAlmostEqual(samples["extrapolation"][i, j, k], float(row["extrapolation"]), 6)
                    self.assertIn(of_regions["region"][i, j, k], (0, 1))
                else:
                    beyond += 1
                    self.assertTrue(-40 < value < 0)
        self.assertGreater(found, len(blocks))  # padding repeats its neighbours
        self.assertGreater(beyond, 1000)

    def test_coarser_levels_are_means_and_subtrees_name_the_tiles_that_there_are(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "t.json", "--voxels", "-tr", "10", "--max-extrapolation", "0.1", "-q")
        tileset = Tileset(self.folder / "t.json")
        self.assertEqual(tileset.levels, 2)
        document, body = read_subtree(self.folder / "t" / "subtrees" / "0_0_0_0.subtree")
        bits = available(document, body, "tileAvailability", 9)
        there = tileset.tiles(1)
        self.assertEqual([(n % 2, n // 2 % 2, n // 4) for n in range(8) if bits[1 + n]], sorted(there, key=lambda t: t[::-1]))
        coarse, d = tileset.samples(0, 0, 0, 0), tileset.dimensions
        for tile in there:
            fine = tileset.samples(1, *tile)
            for i in range(0, d[0], 2):
                for j in range(0, d[1], 2):
                    for k in range(0, d[2], 2):
                        eight = [(i + a, j + b, k + c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
                        values = [fine["K_log10"][at] for at in eight if fine["mask"][at]]
                        at = tuple((t * n + x) // 2 for t, n, x in zip(tile, d, (i, j, k)))
                        self.assertEqual(coarse["mask"][at], math.floor(255 * len(values) / 8 + 0.5))
                        if values:
                            self.assertAlmostEqual(coarse["K_log10"][at], math.fsum(values) / len(values), 5)

    def test_a_tileset_is_whole_or_not_there_and_takes_no_folder_of_others(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        (self.folder / "t").mkdir()
        self.write("t/mine.txt", "mine")
        self.fail_with(1, "export", "m.gpkg", "t.json", "--voxels", "-tr", "40", "-q", saying="exists")
        self.fail_with(1, "export", "m.gpkg", "t.json", "--voxels", "-tr", "40", "--overwrite", "-q", saying="mine.txt")
        self.assertEqual((self.folder / "t" / "mine.txt").read_text(), "mine")
        self.fail_with(2, "export", "m.gpkg", "-", "--of", "VOXELTILES", saying="standard output")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["m.gpkg", "t"])

    def test_R6_a_tileset_has_the_same_bytes_at_any_number_of_threads_and_compressed_ones_are_smaller(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        common = ["export", "m.gpkg", "--voxels", "-tr", "12", "-q"]
        self.succeed(*common, "a/tileset.json", "--threads", 1)
        self.succeed(*common, "b/tileset.json", "v.vdb", "--threads", 2)
        self.succeed(*common, "c/tileset.json", "--compress")
        of = {name: {p.relative_to(self.folder / name): p.read_bytes() for p in (self.folder / name).rglob("*") if p.is_file()}
              for name in "abc"}
        self.assertEqual(of["a"], of["b"])
        self.assertEqual(of["a"].keys(), of["c"].keys())
        self.assertLess(sum(map(len, of["c"].values())), sum(map(len, of["a"].values())) / 2)


def numbers(document, body, index):
    """Of an accessor, by rows."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    letter = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    size = width * struct.calcsize(letter)
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return [struct.unpack_from(f"<{width}{letter}", body, start + n * view.get("byteStride", size)) for n in range(accessor["count"])]


def table(document, body):
    """Rows of the property table."""
    table = document["extensions"]["EXT_structural_metadata"]["propertyTables"][0]
    of_class = document["extensions"]["EXT_structural_metadata"]["schema"]["classes"][table["class"]]["properties"]
    views = document["bufferViews"]
    rows = [{} for _ in range(table["count"])]
    for name, column in table["properties"].items():
        start = views[column["values"]].get("byteOffset", 0)
        if of_class[name]["type"] == "STRING":
            ends = struct.unpack_from(f"<{len(rows) + 1}I", body, views[column["stringOffsets"]].get("byteOffset", 0))
            values = [body[start + a:start + b].decode() for a, b in zip(ends, ends[1:])]
        else:
            values = struct.unpack_from(f"<{len(rows)}f", body, start)
        for row, value in zip(rows, values):
            if value != of_class[name]["noData"]:
                row[name] = value
    return rows


class SurfaceTiles(Case):
    def tiles(self, tile, folder, above=None):
        """(tile, GLB, depth) of all below the root."""
        for child in tile.get("children", []):
            yield child, read_glb(folder / child["content"]["uri"]), tile
            yield from self.tiles(child, folder, tile)

    def test_a_tileset_of_the_scene_has_levels_whose_tiles_lie_in_their_boxes_and_tell_what_is_picked(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "out/tileset.json", "s.glb", "-q")
        tileset = json.loads((self.folder / "out/tileset.json").read_text())
        self.assertEqual(tileset["asset"]["version"], "1.1")
        root, extras = tileset["root"], tileset["extras"]
        self.assertEqual(root["refine"], "ADD")
        self.assertEqual(root["transform"], extras["enu_to_ecef"])
        whole, _ = read_glb(self.folder / "s.glb")
        names = {node["name"] for node in whole["nodes"]}
        leaves, kinds, levels, used = set(), {}, 0, {root["content"]["uri"]}
        for tile, (document, body), parent in self.tiles(root, self.folder / "out"):
            used.add(tile["content"]["uri"])
            self.assertEqual(tile["refine"], "REPLACE")
            self.assertLessEqual(tile["geometricError"], parent["geometricError"])
            self.assertEqual(tile["geometricError"] == 0, "children" not in tile)
            self.assertAlmostEqual(tile["geometricError"], max(tile["extras"]["deviation"], extras["color_metres"] * tile["extras"]["color_deviation"]))
            box, outer = (t["boundingVolume"]["box"] for t in (tile, parent))
            rows = table(document, body)
            for axis in range(3):
                self.assertLessEqual(abs(box[axis] - outer[axis]) + box[3 + 4 * axis], outer[3 + 4 * axis] * 1.000001)
            for node in document["nodes"]:
                primitive = document["meshes"][node["mesh"]]["primitives"][0]
                for x, y, z in numbers(document, body, primitive["attributes"]["POSITION"]):
                    for axis, value in enumerate((x, -z, y)):
                        self.assertLessEqual(abs(value - box[axis]), box[3 + 4 * axis])
                row, = set(numbers(document, body, primitive["attributes"]["_FEATURE_ID_0"]))
                facts = rows[row[0]]
                self.assertIn(facts["name"], node["name"])
                kinds.setdefault(facts["kind"], []).append(facts)
                if "children" not in tile:
                    leaves.add(node["name"])
            levels += "children" in tile
        self.assertGreaterEqual(levels, 1)
        self.assertEqual(leaves | {"extent"}, names)
        self.assertTrue({"section", "isosurface", "borehole", "fault"} <= kinds.keys(), kinds.keys())
        with open(twin_inputs()[1], newline="") as file:
            collars = {row["id"] if "id" in row else next(iter(row.values())) for row in csv.DictReader(file)}
        self.assertEqual({facts["id"] for facts in kinds["borehole"]}, collars)
        self.assertTrue(all(facts["length"] > 100 for facts in kinds["borehole"]))
        self.assertTrue(all(facts["property"] == "K" and facts["value"] > 0 for facts in kinds["isosurface"]))
        self.assertTrue(all(0 < facts["dip"] <= 90 for facts in kinds["fault"]))
        self.assertTrue(all("dip" not in facts and "length" not in facts for facts in kinds["section"]))
        there = {str(p.relative_to(self.folder / "out")) for p in (self.folder / "out/tileset").rglob("*.glb")}
        self.assertEqual(there, used)

    def test_R6_the_scenes_tiles_have_the_same_bytes_at_any_number_of_threads_and_replace_only_tiles(self):
        self.succeed("build", *twin_inputs(), "-o", "m.gpkg")
        self.succeed("export", "m.gpkg", "a/tileset.json", "--threads", 1, "-q")
        self.succeed("export", "m.gpkg", "b/tileset.json", "--threads", 2, "-q")
        self.succeed("export", "m.gpkg", "c/tileset.json", "--compress", "-q")
        self.succeed("export", "m.gpkg", "b/tileset.json", "--overwrite", "-q")
        of = {name: {p.relative_to(self.folder / name): p.read_bytes() for p in (self.folder / name).rglob("*") if p.is_file()}
              for name in "abc"}
        self.assertEqual(of["a"], of["b"])
        self.assertEqual(of["a"].keys(), of["c"].keys())
        self.assertLess(sum(map(len, of["c"].values())), sum(map(len, of["a"].values())) * 0.6)
        self.write("b/tileset/mine.txt", "mine")
        self.fail_with(1, "export", "m.gpkg", "b/tileset.json", "--overwrite", "-q", saying="mine.txt")
        self.fail_with(2, "export", "m.gpkg", "-", "--of", "TILES", saying="standard output")

    def test_a_model_without_a_place_on_the_globe_has_its_tiles_at_its_own_coordinates(self):
        self.write("s.csv", "x,y,z,v\n" + "".join(f"{1000 + 10 * i},{2000 + 10 * j},{-10 * k},{i + j * k}\n"
                                                 for i in range(4) for j in range(4) for k in range(4)))
        self.succeed("convert", "--samples", "s.csv", "-s_srs", "local", "--lmin", "10", "t.json", "-q")
        tileset = json.loads((self.folder / "t.json").read_text())
        x, y, z = tileset["root"]["transform"][12:15]
        self.assertLess(max(abs(x - 1015), abs(y - 2015), abs(z + 15)), 10)


if __name__ == "__main__":
    unittest.main()
