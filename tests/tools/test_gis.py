# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A model file as a product for a GIS: what it says of its layers, how QGIS draws it, spatial indices; and that none of
it is part of the model."""
import json
import math
import pathlib
import shutil
import sqlite3
import struct
import subprocess
import unittest
import xml.etree.ElementTree as xml

from terratet import ROOT, Case, twin_inputs

DEBIAN_PYTHON = "/usr/bin/python3"
HAVE_QGIS = subprocess.run([DEBIAN_PYTHON, "-c", "import qgis.core"], capture_output=True).returncode == 0


class GisProduct(Case):
    def rows(self, sql, name="m.gpkg"):
        database = sqlite3.connect(self.folder / name)
        try:
            return database.execute(sql).fetchall()
        finally:
            database.close()

    def change(self, *statements, name="m.gpkg"):
        database = sqlite3.connect(self.folder / name)
        for sql in statements:
            database.execute(sql)
        database.commit()
        database.close()

    def build_twin(self, *more):
        self.succeed("build", *twin_inputs(), *more, "-o", "m.gpkg")

    def build_rocks(self):
        collars, rows = ["hole,x,y,z"], ["hole,from,to,rock"]
        for hole in range(9):
            collars.append(f"H{hole},{20 + 70 * (hole % 3)},{20 + 70 * (hole // 3)},0")
            for top in range(0, 90, 10):
                kind = "granite" if hole % 3 == 2 else "gneiss & <gabbro>" if top < 40 else "o'schist"
                rows.append(f"H{hole},{top},{top + 10},{kind}")
        self.write("collar.csv", "\n".join(collars) + "\n")
        self.write("log.csv", "\n".join(rows) + "\n")
        self.succeed("build", "--boreholes", "collar.csv", "--log", "log.csv", "-s_srs", "EPSG:3067", "--property",
                     "rock:categorical", "--lmin", "20", "-o", "m.gpkg")

    def qgis(self):
        if not HAVE_QGIS:
            self.skipTest("python3-qgis is not installed")
        done = subprocess.run([DEBIAN_PYTHON, "-B", ROOT / "tests/readers/draw_qgis.py", self.folder / "m.gpkg", self.folder / "map.png"],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.keep_pictures()
        return json.loads(done.stdout)

    def keep_pictures(self):
        import os
        if os.environ.get("TERRATET_PICTURES"):
            for picture in self.folder.glob("*.png"):
                shutil.copy(picture, pathlib.Path(os.environ["TERRATET_PICTURES"]) / f"qgis-{self.id().split('.')[-1]}-{picture.name}")

    def test_qgis_draws_the_twin_in_its_colours_when_it_is_opened(self):
        self.build_twin("-co", "SPATIAL_INDEX=YES")
        found = self.qgis()
        self.assertEqual(found["samples"]["renderer"], "graduatedSymbol")
        self.assertEqual((found["samples"]["drawn"], found["samples"]["colours"]), (1292, 10))
        self.assertEqual((found["vertices"]["renderer"], found["surfaces"]["renderer"]), ("graduatedSymbol", "RuleRenderer"))
        self.assertEqual(len(found["legend"]), 10)
        self.assertEqual({name for name, shown in found["rules"].items() if shown}, {"Domain", "Horizons", "Faults"})
        self.assertEqual(found["samples"]["titles"]["K"], "K [m/s]")
        self.assertEqual(found["boreholes"]["titles"]["length"], "Length [metre]")
        self.assertEqual(found["hole_labels"], "id")
        self.assertTrue(all(found[layer]["index"] for layer in ("boreholes", "samples", "surfaces", "vertices")))
        self.assertGreater(found["painted"], 0.05)

    def test_qgis_draws_classes_and_upright_holes(self):
        self.build_rocks()
        found = self.qgis()
        self.assertEqual((found["samples"]["renderer"], found["samples"]["colours"]), ("categorizedSymbol", 3))
        self.assertEqual(sorted(found["legend"]), ["gneiss & <gabbro>", "granite", "o'schist"])
        self.assertEqual(found["samples"]["drawn"], 81)
        self.assertFalse(found["samples"]["index"])

    def test_a_colour_on_the_map_is_the_legends(self):
        table = ["x,y,z,Fe %"] + [f"{500000 + 100 * (i % 6)},{6800000 + 100 * (i // 6)},{-i % 5},{i}" for i in range(36)]
        self.write("samples.csv", "\n".join(table) + "\n")
        self.succeed("build", "--samples", "samples.csv", "-s_srs", "EPSG:3067", "--lmin", "50", "-o", "m.gpkg")
        found = self.qgis()
        self.assertEqual((found["alone"], found["as_in_legend"]), (36, 36))
        self.assertGreater(found["samples"]["colours"], 5)

    def test_layers_and_columns_are_described(self):
        self.build_twin()
        contents = {name: (title, text) for name, title, text in self.rows("SELECT table_name, identifier, description FROM gpkg_contents")}
        for layer in ("boreholes", "samples", "surfaces", "vertices", "terratet_meta", "terratet_journal", "terratet_changes"):
            title, text = contents[layer]
            self.assertTrue(title and text and title != layer, layer)
        titles = {(table, column): (title, text) for table, column, title, text in
                  self.rows("SELECT table_name, column_name, title, description FROM gpkg_data_columns")}
        self.assertEqual(titles["samples", "K"][0], "K [m/s]")
        self.assertIn("decimal logarithm", titles["samples", "K"][1])
        for layer in ("boreholes", "samples", "vertices"):
            for _, column, *_ in self.rows(f"PRAGMA table_info({layer})"):
                self.assertTrue(column in ("fid", "geom") or (layer, column) in titles, (layer, column))
        for layer, qml, default in self.rows("SELECT f_table_name, styleQML, useAsDefault FROM layer_styles"):
            self.assertEqual(xml.fromstring(qml).tag, "qgis")
            self.assertEqual(default, 1)

    def test_properties_may_be_called_as_other_columns_are_titled(self):
        names = ["Owner", "Vertex", "K", "K_sd", "Extrapolation"]
        rows = [f"{i % 5 * 10 + i % 3},{i // 5 * 10},{i % 7}," + ",".join(str(i % (n + 3)) for n in range(5)) for i in range(30)]
        self.write("s.csv", "x,y,z," + ",".join(names) + "\n" + "\n".join(rows) + "\n")
        self.succeed("convert", "--samples", "s.csv", "-s_srs", "local", "--lmin", "8", "--uncertainty", "m.gpkg")
        self.succeed("check", "m.gpkg")
        titles = [row[0] for row in self.rows("SELECT name FROM gpkg_data_columns WHERE table_name = 'vertices'")]
        self.assertEqual(len(set(titles)), len(titles))
        self.assertTrue(set(names) <= {title.split(" (")[0] for title in titles}, titles)

    def test_boreholes_tell_length_azimuth_and_dip(self):
        self.build_twin()
        for blob, length, azimuth, dip in self.rows("SELECT geom, length, azimuth, dip FROM boreholes"):
            count = struct.unpack_from("<I", blob, 8 + 48 + 5)[0]
            points = [struct.unpack_from("<4d", blob, 8 + 48 + 9 + 32 * i) for i in range(count)]
            way = [b - a for a, b in zip(points[0], points[-1])]
            self.assertAlmostEqual(length, way[3], places=9)
            self.assertAlmostEqual(azimuth, math.degrees(math.atan2(way[0], way[1])) % 360, places=9)
            self.assertAlmostEqual(dip, math.degrees(math.asin(-way[2] / math.dist(points[0][:3], points[-1][:3]))), places=9)
        self.build_rocks_and_see_upright()

    def build_rocks_and_see_upright(self):
        (self.folder / "m.gpkg").unlink()
        self.build_rocks()
        self.assertEqual(set(self.rows("SELECT azimuth, dip FROM boreholes")), {(None, 90)})

    def test_looks_are_no_part_of_the_model(self):
        """A GIS may change them; a file without them, as older ones are, is a model as well."""
        self.build_twin()
        digest = self.succeed("info", "--digest", "m.gpkg").stdout
        self.change("UPDATE layer_styles SET styleQML = 'mine', useAsDefault = 0", "DELETE FROM gpkg_data_columns",
                    "UPDATE gpkg_contents SET description = ''")
        self.assertEqual(self.succeed("info", "--digest", "m.gpkg").stdout, digest)
        self.change("DROP TABLE layer_styles", "DELETE FROM gpkg_contents WHERE table_name = 'layer_styles'",
                    *(f"ALTER TABLE boreholes DROP COLUMN {column}" for column in ("length", "azimuth", "dip")))
        self.succeed("check", "m.gpkg")
        self.assertEqual(self.succeed("info", "--digest", "m.gpkg").stdout, digest)
        self.succeed("edit", "m.gpkg", "move-borehole", "OT-01", "--by", "5,0,0")
        self.assertEqual(self.rows("SELECT count(length) FROM boreholes"), [(1,)])
        self.succeed("edit", "m.gpkg", "undo")
        self.assertEqual(self.succeed("info", "--digest", "m.gpkg").stdout, digest)

    def test_indices_follow_edits(self):
        self.build_twin("-co", "SPATIAL_INDEX=YES")
        digest = self.succeed("info", "--digest", "m.gpkg").stdout
        self.succeed("edit", "m.gpkg", "move-borehole", "OT-01", "--by", "25,-3,0")
        for layer in ("boreholes", "samples", "surfaces", "vertices"):
            rows = {row for row, in self.rows(f"SELECT fid FROM {layer}")}
            self.assertEqual({row for row, in self.rows(f"SELECT id FROM rtree_{layer}_geom")}, rows, layer)
        x, = self.rows("SELECT minx, maxx FROM rtree_boreholes_geom WHERE id = (SELECT fid FROM boreholes WHERE id = 'OT-01')")
        self.assertLess(abs(x[1] - 525430), 0.1)
        self.succeed("edit", "m.gpkg", "undo")
        self.assertEqual(self.succeed("info", "--digest", "m.gpkg").stdout, digest)
        self.succeed("check", "m.gpkg")

    def test_an_index_is_made_on_request_alone(self):
        self.build_twin()
        self.assertEqual(self.rows("SELECT count(*) FROM sqlite_master WHERE name LIKE 'rtree_%'"), [(0,)])
        self.assertIn("SPATIAL_INDEX", self.run_terratet("build", *twin_inputs(), "-co", "RTREE=YES", "-o", "n.gpkg").stderr)


if __name__ == "__main__":
    unittest.main()
