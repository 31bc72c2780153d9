# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file of logs, soundings, wells and tables of the public data is opened, or refused with the right words.

TERRATET_TABLE=1 prints the table: file, and what the program says of it."""
import collections
import json
import os
import unittest

from terratet import Case
from test_real_data import DATA

SETS = ["lasio", "welly", "pygef", "striplog", "swissgeol", "subsurface", "opengeode_gocad"]
# Of surfaces and drawings tests elsewhere tell; side files of a Shapefile are no inputs.
ELSEWHERE = (".ts", ".pl", ".lso", ".vo", ".dxf", ".prj", ".cpg", ".shx", ".dbf", "@@", ".txt")
REFUSED = {"is BRO-XML": 6, "is a time, not a depth": 2, "without a row of data": 3, "Petrel's well tops": 1, "EarthVision": 1,
           "Canstrat": 1, "has no row below its header": 2}
OPENED = {"LAS": 82, "GEF": 9, "GOCAD well": 1}
# As lasio's own tests expect them (tests/examples of lasio, MIT).
VALUES = {
    "lasio/tests/examples/1.2/sample.las": {"DEPT": (1669.75, 1670, 3), "RHOB": (2550, 2550, 3), "ILD": (105.6, 105.6, 3)},
    "lasio/tests/examples/1.2/sample_wrapped.las": {"DEPT": (909.5, 910, 5)},
    "lasio/tests/examples/null_policy_(null).las": {"RHOB": (2550, 2550, 2), "SFLA": (123.45, 123.45, 2)},
    "lasio/tests/examples/null_policy_ERR.las": {"RHOB": (2550, 2550, 2)},
    "lasio/tests/examples/null_policy_runon.las": {"C04": (7.33, 9.207, 3), "C05": (-19508.961, 4648.011, 3)},
    "lasio/tests/examples/comma_decimal_mark.las": {"SFLU": (123.42, 123.45, 3)},
    "lasio/tests/examples/sample_rev.las": {"DEPT": (1660, 1670, None)},
    "lasio/tests/examples/3.0/sample_3.0.las": {"YME": (1.45e12, 2.85e12, 3), "NMR[5]": (13, 25, 3)},
}


@unittest.skipUnless(DATA.exists(), f"{DATA} is not there")
class WellFiles(Case):
    def files(self):
        for name in SETS:
            for path in sorted((DATA / name).rglob("*")):
                if path.is_file() and not path.name.startswith("UPSTREAM_LICENSE") and not path.name.endswith(ELSEWHERE):
                    yield path

    def test_every_file_is_opened_or_refused_with_the_right_words(self):
        opened, refused, files = collections.Counter(), collections.Counter(), 0
        for path in self.files():
            files += 1
            result = self.run_terratet("info", "--json", path)
            words = result.stderr.strip()
            with self.subTest(path.name):
                self.assertIn(result.returncode, (0, 3), words)
                if result.returncode == 0:
                    seen = json.loads(result.stdout)
                    kind = next((known for known in OPENED if seen.get("format", "").startswith(known)), seen["kind"])
                    opened[kind] += 1
                    words = seen.get("summary") or f"{seen['kind']}, {seen.get('rows', 0)} rows, {seen.get('use', 'no holes')}"
                else:
                    known = [key for key in REFUSED if key in words]
                    self.assertEqual(len(known), 1, words)
                    refused[known[0]] += 1
            if os.environ.get("TERRATET_TABLE"):
                print(f"{path.relative_to(DATA)} | {result.returncode} | {words.replace(str(DATA), '')}")
        self.assertEqual(dict(refused), REFUSED)
        for kind, count in OPENED.items():
            self.assertEqual(opened[kind], count, kind)
        self.assertEqual(files, sum(opened.values()) + sum(refused.values()))

    def test_values_are_those_that_lasio_expects(self):
        for name, columns in VALUES.items():
            seen = json.loads(self.succeed("info", "--json", DATA / name).stdout)
            found = {column["name"]: column for key, list_ in seen.items() if key.startswith("columns") for column in list_}
            for column, (lo, hi, count) in columns.items():
                with self.subTest(f"{name} {column}"):
                    self.assertAlmostEqual(found[column]["min"], lo)
                    self.assertAlmostEqual(found[column]["max"], hi)
                    self.assertIn(count, (None, found[column]["numbers"]))
        for spellings in (["utf8", "utf8wbom", "utf16le", "utf16be", "utf16lebom", "utf16bebom"], ["cp1252", "iso88591"]):
            read = [json.loads(self.succeed("info", "--json", DATA / f"lasio/tests/examples/encodings_{name}.las").stdout)["columns"]
                    for name in spellings]
            self.assertEqual(read, [read[0]] * len(read))


if __name__ == "__main__":
    unittest.main()
