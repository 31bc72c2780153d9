# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file of the public data sets, by `terratet info`: opened as what it is, or refused with a reason that tells
what to do. TERRATET_PUBLIC_DATA names their folder, or it is shared/data beside the checkout; without it, skipped."""
import collections
import json
import os
import pathlib
import subprocess
import unittest

from terratet import PROGRAM, ROOT

DATA = pathlib.Path(os.environ.get("TERRATET_PUBLIC_DATA", ROOT.parent / "shared" / "data"))

# Opened: how many of each kind. Refused: how many by words of their message.
EXPECTED = {
    "lasio": ({"LAS": 74}, {"is a time, not a depth": 2, "without a row of data": 3}),
    "welly": ({"LAS": 6, "table": 5}, {}),
    "pygef": ({"GEF-CPT": 8, "GEF-BORE": 1}, {"is BRO-XML": 6}),
    "striplog": ({"LAS": 2, "table": 1}, {"punched cards": 1, "Petrel's well tops": 1}),
    "swissgeol": ({"table": 33}, {"has no row below its header": 2}),
    "opengeode_gocad": ({"surfaces": 7, "GOCAD": 1, "table": 2}, {"no usable GOCAD TSurf": 2}),
    "loopstructural": ({"table": 13}, {"has no row below its header": 1}),
    "subsurface": ({"table": 17, "surfaces": 1}, {"EarthVision": 1, "has no row below its header": 1}),
    "pygslib": ({"table": 9, "VTK": 1, "surfaces": 2}, {"is a PDF": 1, "no 3DFACE": 1}),
}


class PublicFiles(unittest.TestCase):
    def seen(self, folder):
        opened, refused = collections.Counter(), []
        for path in sorted((DATA / folder).rglob("*")):
            if not path.is_file() or path.name.startswith("UPSTREAM_LICENSE"):
                continue
            result = subprocess.run([PROGRAM, "info", "--json", str(path)], capture_output=True, text=True, timeout=120)
            self.assertIn(result.returncode, (0, 3), f"{path}: {result.stderr}")
            if result.returncode == 0:
                described = json.loads(result.stdout)
                opened[described.get("format", described["kind"]).split(" ")[0]] += 1
            else:
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                refused.append(result.stderr)
        return opened, refused

    def test_every_file_is_opened_as_what_it_is_or_refused_with_a_reason(self):
        if not DATA.is_dir():
            self.skipTest(f"the public data are not here ({DATA}; TERRATET_PUBLIC_DATA names another place)")
        for folder, (kinds, reasons) in EXPECTED.items():
            with self.subTest(folder):
                opened, refused = self.seen(folder)
                self.assertEqual(dict(opened), kinds)
                for words, count in reasons.items():
                    self.assertEqual(sum(words in message for message in refused), count, words)
                self.assertEqual(len(refused), sum(reasons.values()))


if __name__ == "__main__":
    unittest.main()
