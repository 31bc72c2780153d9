# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Models and names from anybody: refused with a reason, quickly; nothing of them reaches the terminal as it is."""
import json
import os
import shutil
import sqlite3
import subprocess
import time
import unittest

from terratet import PROGRAM, Case

SAMPLES = "x,y,z,grade\n" + "".join(f"{525000 + 10 * i},{6792000 + 7 * (i % 5)},{-(i * 13) % 40},{i}\n"
                                    for i in range(30))
INPUTS = ["--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80"]
ENDLESS = "WITH RECURSIVE c(fid) AS (SELECT 1 UNION ALL SELECT fid + 1 FROM c) SELECT "


class Hostile(Case):
    def setUp(self):
        super().setUp()
        self.write("s.csv", SAMPLES)
        self.succeed("build", *INPUTS, "-o", "m.gpkg", "-q")

    def changed(self, *statements):
        shutil.copy(self.folder / "m.gpkg", self.folder / "h.gpkg")
        database = sqlite3.connect(self.folder / "h.gpkg", isolation_level=None)
        for statement in statements:
            database.execute(statement)
        database.close()

    ALL = (["check", "h.gpkg"], ["info", "h.gpkg"], ["export", "h.gpkg", "o.vtu"],
           ["query", "h.gpkg", "value", "s.csv"], ["validate", "h.gpkg"], ["info", "--digest", "h.gpkg"])

    def refused_by(self, commands, saying):
        for command in commands:
            for more in ([], ["--accept-edited"]):
                begin = time.monotonic()
                self.fail_with(3, *command, *more, saying=saying)
                self.assertLess(time.monotonic() - begin, 20)

    def test_an_endless_view_in_the_place_of_a_layer(self):
        self.changed("DROP TRIGGER trigger_insert_feature_count_vertices",
                     "DROP TRIGGER trigger_delete_feature_count_vertices",
                     "ALTER TABLE vertices RENAME TO v0",
                     f"CREATE VIEW vertices AS {ENDLESS} c.fid, v0.geom, v0.id FROM c, v0 WHERE v0.fid = 1")
        self.refused_by(self.ALL, "`vertices` must be a table")

    def test_a_trigger_of_another_s_making(self):
        self.changed("CREATE TRIGGER t AFTER INSERT ON samples BEGIN DELETE FROM vertices; END")
        self.refused_by(self.ALL[:1], "trigger `t`")

    def test_numbers_that_no_model_has(self):
        for key, path, value, saying in (("criteria", "l_min", "0.0", "l_min is 0"),
                                         ("frame", "origin[0]", "1e300", "origin is"),
                                         ("frame", "z_scale", "1e300", "z_scale is")):
            self.changed("DELETE FROM terratet_meta WHERE key = 'digest'",
                         f"UPDATE terratet_meta SET value = json_set(value, '$.{path}', json('{value}')) "
                         f"WHERE key = '{key}'")
            self.refused_by(self.ALL[:3], saying)

    def test_a_missing_digest_and_an_edit_on_purpose(self):
        self.changed("DELETE FROM terratet_meta WHERE key = 'digest'")
        for command in (["check", "h.gpkg"], ["info", "h.gpkg"], ["export", "h.gpkg", "o.vtu"],
                        ["query", "h.gpkg", "value", "s.csv"], ["validate", "h.gpkg"]):
            self.fail_with(3, *command, saying="--accept-edited")
        self.assertIn("30", self.succeed("info", "h.gpkg", "--accept-edited").stdout)
        self.succeed("export", "h.gpkg", "o.csv", "-q", "--accept-edited")
        self.succeed("check", "h.gpkg", "--accept-edited")
        # What check would find, every command finds: a kept sample must carry its measured value.
        self.changed("UPDATE vertices SET grade = 1000 WHERE role = 'sample'")
        self.fail_with(3, "export", "h.gpkg", "p.csv", "--accept-edited", saying="does not keep V1")
        self.assertEqual(self.run_terratet("check", "h.gpkg", "--accept-edited").returncode, 1)

    def test_a_database_in_the_middle_of_another_program_s_work(self):
        self.changed("PRAGMA journal_mode = WAL")  # as QGIS does while it has a file open
        self.assertIn("samples", self.succeed("info", "h.gpkg").stdout)


class Terminal(Case):
    HOSTILE = "a\x01b\x1b[31mred\u202egnp\x9b2J"

    def visible(self, text):
        harmful = [c for c in text if (ord(c) < 32 and c not in "\n\t") or 0x7f <= ord(c) < 0xa0 or c == "\u202e"]
        self.assertEqual(harmful, [], repr(text))

    def test_names_are_shown_and_not_obeyed(self):
        name = self.HOSTILE
        self.write("s.csv", SAMPLES.replace("grade", name))
        inputs = ["--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80"]
        result = self.succeed("info", "s.csv")
        self.visible(result.stdout)
        self.assertIn("a\\x01b\\x1b[31mred\\u202egnp\\u009b2J", result.stdout)
        result = self.succeed("build", *inputs, "-o", "m.gpkg")
        self.visible(result.stdout + result.stderr)
        self.assertIn("\\x1b[31mred", result.stderr)
        for arguments in (("info", "m.gpkg"), ("check", "m.gpkg"), ("validate", "m.gpkg"),
                          ("export", "m.gpkg", "o.vtu", "--color", "none\x1b[2J"),
                          ("convert", *inputs, f"o{name}.csv"), ("info", f"none{name}.csv"), (name,),
                          ("convert", "--" + name), ("convert", *inputs, "--property", name + "x", "p.csv")):
            result = self.run_terratet(*arguments)
            self.visible(result.stdout + result.stderr)
        report = self.succeed("convert", *inputs, "q.csv", "-q", "--report", "-").stdout
        self.visible(report)
        self.assertIn(name, json.loads(report)["fidelity"])
        self.assertIn(name, [c["name"] for c in json.loads(self.succeed("info", "--json", "s.csv").stdout)["columns"]])

    def test_bytes_that_are_no_text(self):
        self.write("s.csv", SAMPLES.encode().replace(b"grade", b"Bj\xf6rk"))
        self.succeed("info", "s.csv")
        path = os.fsencode(self.folder) + b"/none\xff\x9b.csv"
        result = subprocess.run([PROGRAM, b"info", path], capture_output=True)
        self.assertEqual(result.returncode, 3)
        self.assertIn(b"\\xff\\x9b", result.stderr)


class Formulas(Case):
    def test_names_and_texts_that_a_spreadsheet_would_run_are_marked_and_survive(self):
        names = ["=cmd|' /C calc'!A0", "+1+1", "@SUM(A1)", "-2+3", "'=quoted", "＝1"]
        rows = "".join(f"{525000 + 10 * i},{6792000 + 7 * (i % 5)},{-(i * 13) % 40},=HYPERLINK(1),"
                       + ",".join("%d" % (i + k - 3) for k in range(len(names))) + "\n" for i in range(30))
        self.write("s.csv", "x,y,z,rock," + ",".join(f'"{n}"' for n in names) + "\n" + rows)
        inputs = ["--samples", "s.csv", "-s_srs", "EPSG:3067", "--lmin", "20", "--lmax", "80"]
        taken = [c["name"] for c in json.loads(self.succeed("info", "--json", "s.csv").stdout)["columns"]]
        self.assertIn("=quoted", taken)  # marked by another program
        self.succeed("convert", *inputs, "--property", "rock:categorical",
                     *[w for n in taken[4:] for w in ("--property", n)], "o.csv", "-q")
        head = (self.folder / "o.csv").read_text().splitlines()[0]
        for cell in head.replace('"', "").split(","):
            self.assertNotIn(cell[:1], tuple("=+-@\t") + ("＝",), head)
        body = (self.folder / "o.csv").read_text()
        self.assertNotIn(",=", body)
        self.assertIn(",'=HYPERLINK(1)", body)
        again = [c["name"] for c in json.loads(self.succeed("info", "--json", "o.csv").stdout)["columns"]]
        for name in taken[4:]:
            self.assertIn(name, again)
        # Numbers stay numbers.
        self.succeed("build", *inputs, "--property", "rock:categorical", "-o", "m.gpkg", "-q")
        out = self.succeed("query", "m.gpkg", "value", "s.csv", "-q").stdout
        self.assertIn(",-3,-2,", out)


if __name__ == "__main__":
    unittest.main()
