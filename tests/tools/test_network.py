# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""No file makes the program call anybody; only what the command line names on a network is read from there."""
import http.server
import json
import sqlite3
import threading
import unittest
import zipfile

from terratet import Case

SAMPLES = "x,y,z,grade\n" + "".join(f"{525000 + 10 * i},{6792000 + 7 * (i % 5)},{-(i * 13) % 40},{i}\n"
                                    for i in range(30))
INPUTS = ["--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80"]


class Network(Case):
    def setUp(self):
        super().setUp()
        test = self
        test.calls = []
        test.served = {}

        class Handler(http.server.BaseHTTPRequestHandler):
            def answer(self, body):
                test.calls.append(self.path)
                content = test.served.get(self.path)
                self.send_response(404 if content is None else 200)
                self.send_header("Content-Length", str(len(content or b"")))
                self.end_headers()
                if body:
                    self.wfile.write(content or b"")

            def do_GET(self):
                self.answer(True)

            def do_HEAD(self):
                self.answer(False)

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        self.url = f"http://127.0.0.1:{self.server.server_port}"
        self.write("s.csv", SAMPLES)

    def silent(self, *arguments):
        result = self.run_terratet(*arguments)
        self.assertIn(result.returncode, (0, 1, 2, 3), result.stderr)
        self.assertEqual(self.calls, [], arguments)
        return result

    def as_everything(self, name):
        self.silent("info", name)
        for option in ("--samples", "--boreholes", "--faults", "--surface", "--topography", "--domain"):
            samples = [] if option == "--samples" else ["--samples", "s.csv"]
            self.silent("convert", option, name, *samples, "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80",
                        "--overwrite", "o.csv")

    def geojson(self, crs):
        ring = [[525000, 6792000, 0], [525300, 6792000, 0], [525300, 6792030, 0], [525000, 6792000, 0]]
        return json.dumps({"type": "FeatureCollection", "crs": crs, "features": [
            {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}]})

    def test_what_the_command_line_names_is_read(self):
        self.served["/s.csv"] = SAMPLES.encode()
        result = self.succeed("info", f"/vsicurl/{self.url}/s.csv")
        self.assertIn("30", result.stdout)
        self.assertGreater(len(self.calls), 0)

    def test_but_not_what_it_names_in_turn(self):
        link = {"type": "link", "properties": {"href": f"{self.url}/crs.wkt", "type": "ogcwkt"}}
        self.served["/a.geojson"] = self.geojson(link).encode()
        self.run_terratet("info", f"/vsicurl/{self.url}/a.geojson")
        self.assertIn("/a.geojson", self.calls)
        self.assertNotIn("/crs.wkt", self.calls)

    def test_links_to_coordinate_systems(self):
        for crs in ({"type": "link", "properties": {"href": f"{self.url}/crs", "type": "ogcwkt"}},
                    {"type": "link", "properties": {"href": f"{self.url}/crs", "type": "proj4"}},
                    {"type": "url", "properties": {"url": f"{self.url}/crs"}},
                    {"type": "name", "properties": {"name": f"{self.url}/crs"}}):
            self.write("a.geojson", self.geojson(crs))
            self.as_everything("a.geojson")

    def test_files_that_are_addresses_of_services(self):
        vrt = (f"<OGRVRTDataSource><OGRVRTLayer name='s'><SrcDataSource>/vsicurl/{self.url}/s.csv</SrcDataSource>"
               "</OGRVRTLayer></OGRVRTDataSource>")
        wms = (f"<GDAL_WMS><Service name='TMS'><ServerUrl>{self.url}/${{z}}</ServerUrl></Service><DataWindow>"
               "<UpperLeftX>525000</UpperLeftX><UpperLeftY>6793000</UpperLeftY><LowerRightX>526000</LowerRightX>"
               "<LowerRightY>6792000</LowerRightY><SizeX>64</SizeX><SizeY>64</SizeY></DataWindow>"
               "<BandsCount>1</BandsCount></GDAL_WMS>")
        raster = (f"<VRTDataset rasterXSize='4' rasterYSize='4'><VRTRasterBand dataType='Float32' band='1'><SimpleSource>"
                  f"<SourceFilename>/vsicurl/{self.url}/dem.tif</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>")
        wfs = f"<OGRWFSDataSource><URL>{self.url}/wfs</URL></OGRWFSDataSource>"
        gml = (f"<?xml version='1.0'?><!DOCTYPE a [<!ENTITY e SYSTEM '{self.url}/entity'>]><gml:FeatureCollection "
               f"xmlns:gml='http://www.opengis.net/gml' xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance' "
               f"xsi:schemaLocation='{self.url}/ns {self.url}/schema.xsd'>&e;</gml:FeatureCollection>")
        kml = (f"<kml xmlns='http://www.opengis.net/kml/2.2'><NetworkLink><Link><href>{self.url}/a.kml</href></Link>"
               "</NetworkLink></kml>")
        for content in (vrt, wms, raster, wfs, gml, kml, f"{self.url}/s.csv"):
            for name in ("a.xml", "a.csv", "a"):
                self.write(name, content)
                self.silent("info", name)
            for option in ("--faults", "--topography", "--domain"):
                self.silent("convert", option, "a.xml", *INPUTS, "--overwrite", "o.csv")

    def test_rasters_with_company(self):
        self.write("dem.asc", "ncols 700\nnrows 700\nxllcorner 525000\nyllcorner 6792000\ncellsize 1\n"
                   + "0 " * 700 * 700)
        overview = (f"<VRTDataset rasterXSize='350' rasterYSize='350'><VRTRasterBand dataType='Float32' band='1'>"
                    f"<SimpleSource><SourceFilename>/vsicurl/{self.url}/dem.tif</SourceFilename></SimpleSource>"
                    "</VRTRasterBand></VRTDataset>")
        self.write("dem.asc.ovr", overview)
        self.write("dem.asc.msk", overview)
        self.write("dem.asc.aux.xml", f"<PAMDataset><SRS>{self.url}/srs</SRS></PAMDataset>")
        self.silent("info", "dem.asc")
        for option in ("--topography", "--surface"):
            self.silent("convert", option, "dem.asc", *INPUTS, "--overwrite", "o.csv")

    def test_databases_and_workbooks(self):
        database = sqlite3.connect(self.folder / "a.sqlite")
        database.execute("CREATE TABLE t (x REAL, y REAL, z REAL, grade REAL)")
        database.execute("INSERT INTO t VALUES (1, 2, 3, 4)")
        database.execute("CREATE VIEW a AS SELECT x, y, z, ogr_geocode('here', 'geometry') AS grade FROM t")
        database.execute("PRAGMA writable_schema = ON")
        database.execute("INSERT INTO sqlite_master VALUES ('table', 'b', 'b', 0, ?)",
                         (f"CREATE VIRTUAL TABLE b USING VirtualOGR('/vsicurl/{self.url}/s.csv')",))
        database.commit()
        database.close()
        for layer in ("a.sqlite", "a.sqlite,layer=a", "a.sqlite,layer=b", "a.sqlite,sql=SELECT * FROM b"):
            self.silent("info", layer)
        with zipfile.ZipFile(self.folder / "a.xlsx", "w") as book:
            book.writestr("xl/workbook.xml", "<workbook xmlns:r='r'><sheets><sheet name='s' sheetId='1' r:id='rId1'/>"
                          "</sheets></workbook>")
            book.writestr("xl/_rels/workbook.xml.rels", f"<Relationships><Relationship Id='rId1' Type='worksheet' "
                          f"TargetMode='External' Target='{self.url}/sheet1.xml'/></Relationships>")
            book.writestr("[Content_Types].xml", f"<!DOCTYPE a [<!ENTITY e SYSTEM '{self.url}/e'>]><Types>&e;</Types>")
        self.as_everything("a.xlsx")

    def test_texts_of_coordinate_systems(self):
        self.write("s.prj", f"{self.url}/prj")
        for srs in (f"{self.url}/crs", f"+proj=longlat +nadgrids={self.url}/grid.gsb"):
            self.write("f.ts", "GOCAD TSurf 1\nHEADER {\nname:f\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME "
                       f"{srs}\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\nVRTX 1 525000 6792000 0\n"
                       "VRTX 2 525020 6792000 0\nVRTX 3 525000 6792020 20\nTRGL 1 2 3\nEND\n")
            self.as_everything("f.ts")
        self.succeed("build", *INPUTS, "-o", "m.gpkg", "-q")
        database = sqlite3.connect(self.folder / "m.gpkg", isolation_level=None)
        database.execute("UPDATE terratet_meta SET value = json_set(value, '$.crs_wkt', ?) WHERE key = 'frame'",
                         (f"{self.url}/crs",))
        database.execute("UPDATE gpkg_spatial_ref_sys SET definition = ?", (f"{self.url}/srs",))
        database.close()
        self.silent("info", "m.gpkg", "--accept-edited")

    def test_a_recipe_is_a_file_too(self):
        self.served["/s.csv"] = SAMPLES.encode()
        self.write("recipe.toml", f'samples = "/vsicurl/{self.url}/s.csv"\ns_srs = "EPSG:3067"\n')
        result = self.silent("convert", "--config", "recipe.toml", "o.csv")
        self.assertEqual(result.returncode, 2)
        self.assertIn("name it on the command line, with --samples", result.stderr)


if __name__ == "__main__":
    unittest.main()
