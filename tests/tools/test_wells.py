# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Well files as inputs: LAS, AGS, GEF, GOCAD and RMS wells, workbooks; where they land, and what is refused."""
import json
import re
import shlex
import sqlite3
import struct
import subprocess
import unittest
import zipfile

from terratet import ROOT, Case

LOCAL = ["-s_srs", "local", "--lmin", "1", "--lmax", "50"]


def las(curves="DEPT.M :\nGR.GAPI :\n", rows="1 10\n2 20\n3 30\n", well="WELL. W-1 :\n", null="-999.25", version="2.0",
        wrap="NO", title="~A\n"):
    return (f"~Version\nVERS. {version} :\nWRAP. {wrap} :\n~Well\nSTRT.M 1 :\nSTOP.M 3 :\nSTEP.M 1 :\nNULL. {null} :\n"
            f"{well}~Curve\n{curves}{title}{rows}")


AGS4 = '''"GROUP","PROJ"
"HEADING","PROJ_ID","PROJ_NAME"
"UNIT","",""
"TYPE","ID","X"
"DATA","1","Site"

"GROUP","TRAN"
"HEADING","TRAN_AGS"
"UNIT",""
"TYPE","X"
"DATA","4.1"

"GROUP","LOCA"
"HEADING","LOCA_ID","LOCA_NATE","LOCA_NATN","LOCA_GL","LOCA_FDEP","LOCA_GREF"
"UNIT","","m","m","m","m",""
"TYPE","ID","2DP","2DP","2DP","2DP","X"
"DATA","BH1","523145.00","178456.12","10.50","20.00","OSGB"
"DATA","BH2","523195.00","178456.12","11.50","20.00","OSGB"

"GROUP","GEOL"
"HEADING","LOCA_ID","GEOL_TOP","GEOL_BASE","GEOL_LEG","GEOL_DESC"
"UNIT","","m","m","",""
"TYPE","ID","2DP","2DP","PA","X"
"DATA","BH1","0.00","4.00","101","Made ground, with ""brick"""
"DATA","BH1","4.00","20.00","201","Clay"
"DATA","BH2","0.00","20.00","201","Clay"

"GROUP","SAMP"
"HEADING","LOCA_ID","SAMP_TOP","SAMP_REF","SAMP_TYPE","SAMP_ID"
"UNIT","","m","","",""
"TYPE","ID","2DP","X","PA","ID"
"DATA","BH1","5.00","1","B","S1"
"DATA","BH1","7.00","2","B","S2"

"GROUP","ISPT"
"HEADING","LOCA_ID","ISPT_TOP","ISPT_NVAL"
"UNIT","","m",""
"TYPE","ID","2DP","0DP"
"DATA","BH1","1.00","12"
"DATA","BH1","6.00","30"
"DATA","BH2","6.00","25"

"GROUP","LNMC"
"HEADING","LOCA_ID","SAMP_TOP","SAMP_REF","SAMP_TYPE","SAMP_ID","LNMC_MC"
"UNIT","","m","","","","%"
"TYPE","ID","2DP","X","PA","ID","MC"
"DATA","BH1","5.00","1","B","S1","23.5"
"DATA","BH1","","","","S2","24.5"
'''


class Files(Case):
    def points(self, *arguments):
        """The samples of the model, as they were measured."""
        self.succeed("build", *arguments, "--overwrite", "-q", "-o", "m.gpkg")
        rows = []
        base = sqlite3.connect(self.folder / "m.gpkg")
        base.row_factory = sqlite3.Row
        for row in base.execute("SELECT * FROM samples"):
            row = dict(row)
            point = row.pop("geom")
            begin = 8 + {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[point[3] >> 1 & 7] + 5
            row["x"], row["y"], row["z"] = struct.unpack("<3d", point[begin:begin + 24])
            rows.append(row)
        base.close()
        return rows

    def database(self, name, tables):
        path = self.folder / name
        with sqlite3.connect(path) as base:
            for table, (columns, rows) in tables.items():
                base.execute(f"CREATE TABLE \"{table}\" ({', '.join(columns)})")
                base.executemany(f"INSERT INTO \"{table}\" VALUES ({', '.join('?' * len(columns))})", rows)
        base.close()
        return path

    COLLARS = (["hole TEXT", "x REAL", "y REAL", "z REAL"], [("A", 0, 0, 0), ("B", 100, 0, 0)])
    SURVEY = (["hole TEXT", "depth REAL", "azimuth REAL", "dip REAL"], [("A", 0, 90, 0), ("B", 0, 0, 90)])
    ASSAY = (["hole TEXT", '"from" REAL', '"to" REAL', "Cu REAL"], [("A", 0, 10, 1), ("A", 10, 20, 2), ("B", 0, 10, 3)])
    LITHOLOGY = (["hole TEXT", '"from" REAL', '"to" REAL', "rock TEXT"], [("A", 0, 20, "tuff"), ("B", 0, 10, "dyke")])


class Wells(Files):
    def info(self, path):
        return json.loads(self.succeed("info", "--json", path).stdout)

    def heights(self, rows, name):
        return {round(float(row["z"]), 4): float(row[name]) for row in rows if row[name] is not None}

    # --- LAS ---------------------------------------------------------------------------------------------------------

    def test_a_las_file_with_its_own_place_is_a_hole_with_its_log(self):
        path = self.write("w.las", las(well="WELL. W-1 :\nX.M 500 :\nY.M 700 :\nEKB.M 100 :\n"))
        rows = self.points("--boreholes", path, *LOCAL)
        self.assertEqual(self.heights(rows, "GR"), {99: 10, 98: 20, 97: 30})
        self.assertEqual({(float(row["x"]), float(row["y"])) for row in rows}, {(500, 700)})
        seen = self.info(path)
        self.assertEqual((seen["format"], seen["curves"], seen["well"]), ("LAS 2.0", 2, "W-1"))
        self.assertEqual(seen["logs"][0]["depths"], [1, 3])
        self.assertIn("LAS 2.0, 2 curves", self.succeed("info", path).stdout)

    def test_degrees_and_a_datum_in_the_header_are_a_place(self):
        path = self.write("w.las", las(well="WELL. W-1 :\nLATI. 45 30 00 N :\nLONG. 75°15'00\" W :\nGDAT. NAD83 :\nEGL.F 328.0839895 :\n"))
        rows = self.points("--boreholes", path, "-t_srs", "EPSG:26918", "--lmin", "0.5", "--lmax", "50")
        east, north, _ = subprocess.run(["gdaltransform", "-s_srs", "EPSG:4269", "-t_srs", "EPSG:26918"], input="-75.25 45.5\n",
                                        capture_output=True, text=True, check=True).stdout.split()
        self.assertAlmostEqual(rows[0]["x"], float(east), places=3)
        self.assertAlmostEqual(rows[0]["y"], float(north), places=3)
        self.assertEqual(sorted(round(float(row["z"]), 3) for row in rows), [97, 98, 99])

    def test_logs_join_the_collar_table_by_uwi_api_name_and_file_name(self):
        self.write("c.csv", "hole,uwi,api,name,x,y,z\nA,100/01,4-1,Alpha,0,0,0\nB,100/02,4-2,Beta,100,0,0\n"
                            "C,100/03,4-3,Gamma,0,100,0\nD,100/04,4-4,Delta 4,100,100,0\n")
        self.write("1.las", las(well="WELL. x :\nUWI. 100/01 :\n"))
        self.write("2.las", las(well="WELL. x :\nAPI. 4-2 :\n"))
        self.write("3.las", las(well="WELL. Gamma :\n"))
        self.write("delta-4.las", las(well=""))
        rows = self.points("--boreholes", "c.csv", "--log", "1.las", "--log", "2.las", "--log", "3.las", "--log", "delta-4.las", *LOCAL)
        self.assertEqual({(float(row["x"]), float(row["y"])) for row in rows}, {(0, 0), (100, 0), (0, 100), (100, 100)})
        self.assertEqual(len(rows), 12)
        by_folder = self.points("--boreholes", "c.csv", "--log", "*.las", *LOCAL)
        self.assertEqual(rows, by_folder)
        self.write("strange.las", las(well="WELL. nobody :\n"))
        self.fail_with(3, "convert", "--boreholes", "c.csv", "--log", "strange.las", *LOCAL, "q.csv", saying="is in no collar table")

    def test_a_folder_of_logs_passes_over_what_is_none(self):
        (self.folder / "logs").mkdir()
        for k in range(3):
            self.write(f"logs/{k}.las", las(well=f"WELL. W{k} :\nX.M {100 * k} :\nY.M 0 :\nEKB.M 10 :\n"))
        self.write("logs/readme.txt", "three wells\n")
        result = self.succeed("convert", "--boreholes", "logs", *LOCAL, "o.csv")
        self.assertIn("readme.txt", result.stderr)
        self.assertEqual({row["x"] for row in self.points("--boreholes", "logs", *LOCAL)}, {0, 100, 200})
        self.assertEqual(self.info("logs")["count"], 4)

    def test_the_depth_unit_of_a_log_counts(self):
        self.write("c.csv", "hole,x,y,z\nW-1,0,0,0\n")
        self.write("w.las", las(curves="DEPT.F :\nGR. :\n", rows="100 1\n200 2\n"))
        rows = self.points("--boreholes", "c.csv", "--log", "w.las", *LOCAL)
        self.assertEqual(self.heights(rows, "GR"), {-30.48: 1, -60.96: 2})
        self.write("w.las", las(curves="DEPT..1IN :\nGR. :\n", rows="12000 1\n24000 2\n"))
        rows = self.points("--boreholes", "c.csv", "--log", "w.las", *LOCAL)
        self.assertEqual(self.heights(rows, "GR"), {-30.48: 1, -60.96: 2})

    def test_what_lasio_forgives_is_forgiven(self):
        self.write("c.csv", "hole,x,y,z\nW-1,0,0,0\n")
        cases = {
            "wrapped": las(curves="DEPT.M :\nA. :\nGR. :\nB. :\n", rows="1\n0 10\n5\n2\n0 20\n5\n3\n0 30\n5\n", wrap="YES"),
            "wrapped and not said so": las(curves="DEPT.M :\nA. :\nGR. :\n", rows="1\n0 10\n2\n0 20\n3\n0 30\n"),
            "descending": las(rows="3 30\n2 20\n1 10\n"),
            "nulls": las(curves="DEPT.M :\nGR. :\nN. :\n", null="-9999.00",
                         rows="1 10 -9999.0\n2 20 (null)\n3 30 -9.999E+03\n4 -9999 1\n5 ERR 2\n6 -- 3\n7 NaN 4\n"),
            "decimal commas": las(rows="1,0 10,0\n2,0 20,0\n3,0 30,0\n"),
            "commas between": las(rows="1,10\n2,20\n3,30\n").replace("WRAP. NO :\n", "WRAP. NO :\nDLM. COMMA :\n"),
            "commas between and not said so": las(rows="1,10\n2,20\n3,30\n"),
            "tabs": las(curves="DEPT.M :\nN. :\nGR. :\n", rows="1\t\t10\n2\t\t20\n3\t\t30\n").replace("WRAP. NO :\n", "WRAP. NO :\nDLM. TAB :\n"),
            "no curves": las(curves="", title="~A DEPT GR\n"),
            "run on": las(curves="DEPT.M :\nA. :\nB. :\nGR. :\n", rows="1 -1.5-2.5 10\n2 -1.5-2.5 20\n3 -1.5-2.5 30\n"),
            "twice a mnemonic": las(curves="DEPT.M :\nGR. :\nGR. :\n", rows="1 10 7\n2 20 7\n3 30 7\n"),
            "1.2": las(version="1.2", well="WELL. WELL: W-1\n"),
            "no index": las(curves="A.V :\nGR.API :\n", rows="5 10\n5 20\n5 30\n"),
            "UTF-16": las().encode("utf-16"), "UTF-16 without mark": las().encode("utf-16-be"),
            "Windows": las(curves="DEPT.M :\nGR.\xb5R/h :\n").encode("cp1252"), "Macintosh": las().replace("\n", "\r").encode(),
            "comments": "# by hand\n\n" + las(rows="#\n1 10\n# not this\n2 20\n\n3 30\n"),
            "Fortran": las(rows="1 1.0D+01\n2 2.0D+01\n3 .3D+02\n"),
        }
        for name, text in cases.items():
            with self.subTest(name):
                self.write("w.las", text)
                rows = self.points("--boreholes", "c.csv", "--log", "w.las", "--property", "GR", *LOCAL)
                self.assertEqual(self.heights(rows, "GR"), {-1: 10, -2: 20, -3: 30})

    def test_las_3_has_tops_tests_and_its_survey(self):
        self.write("c.csv", "hole,x,y,z\nW-1,0,0,0\n")
        self.write("w.las", las(version="3.0").replace("WRAP. NO :\n", "WRAP. NO :\nDLM. COMMA :\n").replace("~A\n1 10\n2 20\n3 30\n", """~Inclinometry_Definition
MD. M : Measured Depth {F}
AZIM.DEG : Azimuth {F}
DEVI.DEG : Deviation {F}
~Inclinometry_Data | Inclinometry_Definition
0,90,90
~Core_Definition
CORET.M : Core Top Depth {F}
COREB.M : Core Bottom Depth {F}
PERM.MD : Permeability {F}
CDES. : Description {S}
~Core_Data[1] | Core_Definition
10,20,5,"Sand, and
more of it"
~Log_Data | Log_Definition
1,10
2,20
""").replace("~Curve\n", "~Log_Definition\n"))
        rows = self.points("--boreholes", "c.csv", "--log", "w.las", *LOCAL)
        self.assertEqual({round(float(row["x"]), 6): float(row["GR"]) for row in rows if row["GR"]}, {1: 10, 2: 20})
        self.assertEqual([(round(float(row["x"]), 6), float(row["PERM"])) for row in rows if row["PERM"]], [(15, 5)])
        classes = self.points("--boreholes", "c.csv", "--log", "w.las", "--property", "CDES:categorical", *LOCAL)
        self.assertEqual([row["CDES"] for row in classes], ["Sand, and more of it"])

    def test_what_is_called_las_and_is_none_is_refused_by_name(self):
        self.write("c.csv", "hole,x,y,z\nW-1,0,0,0\n")
        self.write("cloud.las", b"LASF" + bytes(400))
        for command in (["info", "cloud.las"], ["convert", "--boreholes", "c.csv", "--log", "cloud.las", *LOCAL, "o.csv"],
                        ["convert", "--samples", "cloud.las", *LOCAL, "o.csv"]):
            self.fail_with(3, *command, saying="is a LiDAR point cloud")
        self.write("time.las", las(curves="ETIM.S :\nGR. :\n"))
        self.fail_with(3, "info", "time.las", saying="is a time, not a depth")
        self.write("empty.las", las(rows=""))
        self.fail_with(3, "info", "empty.las", saying="without a row of data")
        self.write("w.las", las())
        self.fail_with(3, "convert", "--samples", "w.las", *LOCAL, "o.csv", saying="is a LAS well log, not a table; name it with --boreholes or --log")
        self.fail_with(3, "convert", "--boreholes", "w.las", *LOCAL, "o.csv", saying="has no place in its header")

    # --- AGS, GEF ----------------------------------------------------------------------------------------------------

    def test_ags_4_brings_its_holes_tests_and_strata(self):
        path = self.write("s.ags", AGS4)
        rows = self.points("--boreholes", path, "--lmin", "0.1", "--lmax", "50")
        self.assertEqual(self.heights(rows, "ISPT_NVAL"), {9.5: 12, 4.5: 30, 5.5: 25})
        self.assertEqual(self.heights(rows, "LNMC_MC"), {5.5: 23.5, 3.5: 24.5})  # the second by its sample's number
        classes = self.points("--boreholes", path, "--property", "GEOL_LEG:categorical", "--lmin", "0.1", "--lmax", "50")
        self.assertEqual({(round(float(row["z"]), 3), row["GEOL_LEG"]) for row in classes},
                         {(8.5, "101"), (-1.5, "201"), (1.5, "201")})
        seen = self.info(path)
        self.assertEqual((seen["format"], seen["holes"]), ("AGS 4.1", "2"))
        self.assertIn("27700", seen["crs"])
        self.write("c.csv", "hole,x,y,z\nBH1,0,0,0\nBH2,50,0,0\n")
        rows = self.points("--boreholes", "c.csv", "--log", path, "--property", "ISPT_NVAL", *LOCAL)
        self.assertEqual({(row["x"], row["z"], row["ISPT_NVAL"]) for row in rows}, {(0, -1, 12), (0, -6, 30), (50, -6, 25)})

    def test_ags_3_is_read_and_named(self):
        path = self.write("s.ags", '"**PROJ"\n"*PROJ_ID","*PROJ_NAME"\n"<UNITS>",""\n"1","Old"\n\n'
                          '"**HOLE"\n"*HOLE_ID","*HOLE_NATE","*HOLE_NATN","*HOLE_GL","*HOLE_FDEP"\n"<UNITS>","m","m","m","m"\n'
                          '"BH1","100","200","10","20"\n\n"**ISPT"\n"*HOLE_ID","*ISPT_TOP",\n"*ISPT_NVAL","*ISPT_REM"\n'
                          '"<UNITS>","m","",""\n"BH1","1.0","12","first part "\n"<CONT>","","","and second"\n"BH1","3.0","30",""\n')
        rows = self.points("--boreholes", path, *LOCAL)
        self.assertEqual(self.heights(rows, "ISPT_NVAL"), {9: 12, 7: 30})
        self.assertEqual(self.info(path)["format"], "AGS 3")

    def test_gef_soundings_and_borings(self):
        head = "#GEFID= 1, 1, 0\n#TESTID= T1\n#XYID= 31000, 120000, 480000\n#ZID= 31000, 5.0\n"
        cpt = self.write("t.gef", head + "#COLUMNINFO= 1, m, length, 1\n#COLUMNINFO= 2, MPa, qc, 2\n#COLUMNINFO= 3, m, depth, 11\n"
                         "#COLUMNVOID= 2, 9999\n#COLUMNSEPARATOR= ;\n#RECORDSEPARATOR= !\n#MEASUREMENTVAR= 13, 1, m, dug\n#EOH=\n"
                         "0.5;3;0.5;!\n1.0;9999;1.0;!\n2.0;4;1.9;!\n3.0;6;2.8;!\n")
        rows = self.points("--boreholes", cpt, "--lmin", "0.1", "--lmax", "50")
        self.assertEqual(self.heights(rows, "qc"), {3.1: 4, 2.2: 6})
        self.assertIn("28992", self.info(cpt)["crs"])
        dug = self.write("d.gef", head + "#COLUMNINFO= 1, m, length, 1\n#COLUMNINFO= 2, MPa, qc, 2\n#MEASUREMENTVAR= 13, 1, m, dug\n#EOH=\n"
                         "-0 3\n0.5 4\n")
        self.fail_with(3, "info", dug, saying="all its 2 rows lie in the 1 m dug before the test")
        bore = self.write("b.gef", head + "#REPORTCODE= GEF-BORE-Report, 1, 0, 0\n#COLUMNTEXT= 1, aan\n#COLUMNSEPARATOR= ;\n#RECORDSEPARATOR= !\n"
                          "#COLUMNINFO= 1, m, top, 1\n#COLUMNINFO= 2, m, base, 2\n#COLUMNINFO= 3, mm, median, 8\n#EOH=\n"
                          "0.0;2.0;200;'Zs1';'GR';!\n2.0;6.0;300;'Kz2';!\n")
        rows = self.points("--boreholes", bore, "--property", "median", "--property", "SOIL:categorical", "--lmin", "0.1", "--lmax", "50")
        self.assertEqual({(float(row["z"]), float(row["median"]), row["SOIL"]) for row in rows}, {(4, 200, "Zs1"), (1, 300, "Kz2")})
        self.assertEqual(self.info(bore)["format"], "GEF-BORE")
        self.fail_with(3, "info", self.write("x.gef", head), saying="without #EOH=")

    # --- Wells with paths --------------------------------------------------------------------------------------------

    def test_a_gocad_well_has_its_path_markers_and_curves(self):
        path = self.write("w.wl", "GOCAD Well 1\nHEADER {\nname: P 1\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME x\nZPOSITIVE Depth\n"
                          "END_ORIGINAL_COORDINATE_SYSTEM\nWREF 1000 2000 -50\nPATH 0 -50 0 0\nPATH 100 50 0 0\nPATH 200 50 100 0\n"
                          "MRKR Top 1 150\nZONE upper 0 100 1\nWELL_CURVE\nPROPERTY GR\nPROP_UNIT API\nPROP_NO_DATA_VALUE -999\n"
                          "REC 50 7\nREC 150 9\nREC 170 -999\nEND_CURVE\nEND\n")
        rows = self.points("--boreholes", path, *LOCAL)
        self.assertEqual({(float(row["x"]), float(row["y"]), float(row["z"]), float(row["GR"])) for row in rows},
                         {(1000, 2000, 0, 7), (1050, 2000, -50, 9)})
        classes = self.points("--boreholes", path, "--property", "ZONE:categorical", "--property", "MARKER:categorical", *LOCAL)
        self.assertEqual({(float(row["z"]), row["ZONE"] or row["MARKER"]) for row in classes}, {(0, "upper"), (-50, "Top")})
        self.assertEqual(self.info(path)["format"], "GOCAD well")

    def test_a_gocad_well_of_stations_is_desurveyed(self):
        path = self.write("w.wl", "GOCAD Well 1\nHEADER {\nname:S\n}\nWREF 0 0 100\nSTATION 0 90 90\nWELL_CURVE\nPROPERTY GR\nREC 10 1\n"
                          "REC 20 2\nEND_CURVE\nEND\n")
        rows = self.points("--boreholes", path, *LOCAL)
        self.assertEqual({(round(float(row["x"]), 6), round(float(row["z"]), 6)) for row in rows}, {(10, 100), (20, 100)})

    def test_an_rms_well_has_its_path_and_its_codes(self):
        path = self.write("w.rmswell", "1.0\nUndefined\nOP_1 1000 2000 25\n3\nMD UNK lin\nPoro UNK lin\nZone DISC 1 Upper 2 Lower\n"
                          "1000 2000 0 25 0.1 1\n1000 2000 100 125 0.2 1\n1000 2060 180 225 0.3 2\n1000 2120 260 325 -999 2\n")
        rows = self.points("--boreholes", path, "--property", "Poro", *LOCAL)
        self.assertEqual({(float(row["y"]), float(row["z"]), float(row["Poro"])) for row in rows},
                         {(2000, 0, 0.1), (2000, -100, 0.2), (2060, -180, 0.3)})
        classes = self.points("--boreholes", path, "--property", "Zone:categorical", *LOCAL)
        self.assertEqual([row["Zone"] for row in classes].count("Lower"), 2)
        self.assertEqual(self.info(path)["format"], "RMS well")

    # --- Containers --------------------------------------------------------------------------------------------------

    def test_a_database_is_known_by_what_its_layers_hold(self):
        path = self.database("d.sqlite", {"notes": (["text TEXT"], [("x",)]), "t1": self.ASSAY, "t2": self.COLLARS,
                                          "t3": self.SURVEY, "t4": self.LITHOLOGY})
        rows = self.points("--boreholes", path, "--property", "Cu", "--property", "rock:categorical", *LOCAL)
        self.assertEqual({(round(float(row["x"]), 6), round(float(row["z"]), 6), row["Cu"]) for row in rows if row["Cu"]},
                         {(5, 0, 1), (15, 0, 2), (100, -5, 3)})
        self.assertEqual({row["rock"] for row in rows if row["rock"]}, {"tuff", "dyke"})
        result = self.run_terratet("convert", "--boreholes", path, *LOCAL, "--overwrite", "o.csv")
        self.assertIn("collars from layer t2, surveys from t3, logs from t1, t4", " ".join(result.stderr.split()))
        layers = {layer["name"]: layer["use"] for layer in self.info(path)["layers"]}
        self.assertEqual(layers, {"notes": "other", "t1": "log", "t2": "collar", "t3": "survey", "t4": "log"})

    def test_logs_of_several_layers_are_taken_together(self):
        path = self.database("d.sqlite", {"t1": self.ASSAY, "t4": self.LITHOLOGY})
        self.write("c.csv", "hole,x,y,z\nA,0,0,0\nB,100,0,0\n")
        rows = self.points("--boreholes", "c.csv", "--log", path, "--property", "Cu", "--property", "rock:categorical", *LOCAL)
        self.assertEqual(sum(bool(row["Cu"]) for row in rows), 3)
        self.assertEqual(sum(bool(row["rock"]) for row in rows), 2)

    def test_two_tables_of_collars_are_refused_with_all_layers_named(self):
        path = self.database("d.sqlite", {"old": self.COLLARS, "new": self.COLLARS, "t1": self.ASSAY})
        line = self.fail_with(3, "convert", "--boreholes", path, *LOCAL, "o.csv", saying="can be the collars")
        self.assertIn("t1 (log)", line)
        rows = self.points("--boreholes", f"{path},layer=new", "--log", f"{path},layer=t1", *LOCAL)
        self.assertEqual(len(rows), 3)

    def test_what_is_in_a_zip_is_read(self):
        with zipfile.ZipFile(self.folder / "w.zip", "w") as archive:
            archive.writestr("w.las", las(well="WELL. W-1 :\nX.M 5 :\nY.M 7 :\nEKB.M 0 :\n"))
        rows = self.points("--boreholes", f"/vsizip/{self.folder}/w.zip/w.las", *LOCAL)
        self.assertEqual(self.heights(rows, "GR"), {-1: 10, -2: 20, -3: 30})


class Documented(Files):
    """Each row of docs/inputs.md: files of that kind, and what is typed."""

    def test_each_row_of_the_page_runs(self):
        own = "WELL. W-1 :\nX.M 500000 :\nY.M 6000000 :\nEKB.M 100 :\n"
        (self.folder / "logs").mkdir()
        for name, text in {
                "w.las": las(well=own), "a.las": las(well="WELL. A :\n"), "b.las": las(well="UWI. 2 :\n"),
                "logs/a.las": las(well="WELL. A :\n"), "site.ags": AGS4,
                "collar.csv": "hole,uwi,x,y,z\nA,1,500000,6000000,10\nB,2,500100,6000000,10\nBH1,3,500000,6000100,10\nBH2,4,500100,6000100,10\n",
                "cpt.gef": "#GEFID= 1, 1, 0\n#TESTID= T\n#XYID= 31000, 120000, 480000\n#ZID= 31000, 5\n#COLUMNINFO= 1, m, length, 1\n"
                           "#COLUMNINFO= 2, MPa, qc, 2\n#EOH=\n1 3\n2 4\n",
                "well.wl": "GOCAD Well 1\nHEADER {\nname:P\n}\nWREF 500000 6000000 0\nPATH 0 0 0 0\nPATH 9 -9 0 0\nWELL_CURVE\nPROPERTY GR\n"
                           "REC 5 7\nREC 7 8\nEND_CURVE\nEND\n",
                "well.rmswell": "1.0\nU\nO 500000 6000000\n1\nPoro UNK lin\n500000 6000000 0 0.1\n500000 6000000 9 0.2\n"}.items():
            self.write(name, text)
        base = self.database("site.sqlite", {"a": self.COLLARS, "b": self.SURVEY, "c": self.ASSAY})
        self.assertTrue(base.exists())
        self.database("site2.sqlite", {"old": self.COLLARS, "new": self.COLLARS, "assay": self.ASSAY})
        with zipfile.ZipFile(self.folder / "w.zip", "w") as archive:
            archive.writestr("w.las", las(well=own))
        page = (ROOT / "docs" / "inputs.md").read_text()
        table = page.split("## I have")[1].split("\n## ")[0]
        typed = [words for row in re.findall(r"^\| .* \| (`--.*) \|$", table, re.M) for words in re.findall(r"`(--[^`]*)`", row)]
        self.assertGreater(len(typed), 11)
        for words in typed:
            arguments = shlex.split(words)
            if "--boreholes" not in arguments:  # "or …": the end of the command before
                arguments = ["--boreholes", "collar.csv", *arguments, "-s_srs", "EPSG:32633"]
            with self.subTest(words):
                self.succeed("build", *arguments, "--lmin", "1", "--lmax", "100", "--overwrite", "-q", "-o", "model.gpkg")


class Info(Case):
    """Outputs are named too."""

    def test_each_output_is_named_with_its_extent(self):
        self.write("s.csv", "x,y,z,v\n" + "".join(f"{x},{y},{z},{x}\n" for x in (0, 50, 100) for y in (0, 50, 100) for z in (0, 50, 100)))
        self.succeed("convert", "--samples", "s.csv", "-s_srs", "EPSG:32633", "-te", "0", "0", "0", "100", "100", "100", "--lmin", "20",
                     "m.gpkg", "m.vtu", "m.glb", "m.gltf", "m.vdb", "e.uge", "i.ugi", "m.msh", "m.html", "m.png", "m.vtm", "m.pvd",
                     "m.nc", "m.tif", "t.json,of=VOXELTILES", "-tr", "10")
        for name, words in (("m.vtu", "UnstructuredGrid"), ("m.glb", "glTF 2.0 binary"), ("m.gltf", "glTF 2.0"), ("m.vdb", "OpenVDB"),
                            ("e.uge", "PFLOTRAN explicit"), ("i.ugi", "PFLOTRAN implicit"), ("m.msh", "Gmsh mesh 4.1"),
                            ("m.html", "HTML page"), ("m.png", "PNG"), ("m.vtm", "MultiBlock"), ("m.pvd", "Collection"),
                            ("m.nc", "netCDF"), ("m.tif", "GTiff"), ("t.json", "3D Tiles")):
            seen = json.loads(self.succeed("info", "--json", name).stdout)
            self.assertEqual(seen["kind"], "output")
            self.assertIn(words, seen["format"])
        for pair in (("q.uge", "q.ugi"), ("q.vtm", "q.json,of=VOXELTILES")):  # one would write over the other's files
            self.fail_with(2, "export", "m.gpkg", *pair, "-tr", "10", saying="both put files into the folder q")
        seen = json.loads(self.succeed("info", "--json", "m.glb").stdout)
        self.assertIn("32633", seen["crs"])
        lo, hi = seen["extent"][:3], seen["extent"][3:]
        for k in range(3):
            self.assertLessEqual(lo[k], 1)
            self.assertGreaterEqual(hi[k], 99)
        self.assertIn("32633", json.loads(self.succeed("info", "--json", "m.vdb").stdout)["crs"])
        self.assertEqual(json.loads(self.succeed("info", "--json", "m.gpkg").stdout)["kind"], "model")
        with open(self.folder / "m.glb", "rb") as whole:
            self.write("cut.glb", whole.read(600))
        self.fail_with(3, "info", "cut.glb", saying="cut short")


class Holes(Case):
    def test_the_quality_report_counts_what_is_wrong(self):
        self.write("c.csv", "hole,x,y,z,length\nA,0,0,0,100\nB,50,0,0,100\nC,0,0,0,100\nD,9,9,0,50\nA,7,7,7,5\n")
        self.write("s.csv", "hole,depth,azimuth,dip\nA,0,0,90\nA,30,0,60\nA,60,0,60\nB,0,0,90\nB,0,0,90\nD,0,10,80\nD,40,12,79\nX,0,0,90\n")
        self.write("l.csv", "hole,from,to,v\nA,0,10,1\nA,8,20,1\nA,30,40,1\nB,0,10,1\nB,0,10,2\nB,90,120,1\nD,20,10,1\nD,0,5,1\nY,0,1,1\n")
        arguments = ["info", "--holes", "--boreholes", "c.csv", "--survey", "s.csv", "--log", "l.csv"]
        seen = json.loads(self.succeed(*arguments, "--json", "-o", "worst.svg").stdout)
        self.assertEqual({defect: count for defect, count in seen["counts"].items() if count},
                         {"overlap": 1, "gap": 2, "missing survey": 1, "kink": 1, "duplicate collar": 1, "duplicate place": 1,
                          "duplicate station": 1, "duplicate interval": 1, "without log": 1, "without collar": 2,
                          "beyond length": 1, "turned interval": 1})
        self.assertEqual((seen["holes"], seen["surveyed"], seen["logged"], seen["worst"]), (4, 3, 3, "A"))
        gap = next(row for row in seen["list"] if row["defect"] == "gap")
        self.assertEqual((gap["hole"], gap["from"], gap["to"], gap["line"]), ("A", 20, 30, 4))
        picture = (self.folder / "worst.svg").read_text()
        self.assertIn('class="gap"', picture)
        self.assertIn('class="kink"', picture)
        self.assertIn(">A: ", picture)
        text = self.succeed(*arguments).stdout
        self.assertIn("overlap 1", text)
        self.fail_with(1, *arguments, "-o", "worst.svg", saying="--overwrite")

    def test_sound_holes_have_no_findings(self):
        self.write("c.csv", "hole,x,y,z,length\nA,0,0,0,100\nB,50,0,0,100\n")
        self.write("s.csv", "hole,depth,azimuth,dip\nA,0,0,90\nA,60,5,88\nB,0,0,90\n")
        self.write("l.csv", "hole,from,to,v\nA,0,10,1\nA,10,100,1\nB,0,100,1\n")
        seen = json.loads(self.succeed("info", "--holes", "--boreholes", "c.csv", "--survey", "s.csv", "--log", "l.csv", "--json").stdout)
        self.assertEqual(seen["findings"], 0)
        self.assertIsNone(seen["worst"])

    def test_usage(self):
        self.fail_with(2, "info", saying="name a FILE")
        self.fail_with(2, "info", "--boreholes", "c.csv", saying="go with --holes")
        self.fail_with(2, "info", "--holes", saying="no input")


if __name__ == "__main__":
    unittest.main()
