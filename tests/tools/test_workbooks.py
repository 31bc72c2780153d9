# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Well-formed workbooks whose XML holds entities: small ones are read, bombs and files from outside are not."""
import unittest
import zipfile

from terratet import Case

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
TYPES = "application/vnd.openxmlformats-officedocument.spreadsheetml"
LAUGH = '<!DOCTYPE {} [<!ENTITY a "aaaaaaaaaa">' + "".join(
    f'<!ENTITY {chr(98 + i)} "{("&" + chr(97 + i) + ";") * 10}">' for i in range(8)) + "]>"


def relations(*targets):
    return f'<Relationships xmlns="{PACKAGE}/relationships">' + "".join(
        f'<Relationship Id="rId{i + 1}" Type="{OFFICE}/{kind}" Target="{target}"/>'
        for i, (kind, target) in enumerate(targets)) + "</Relationships>"


def workbook(path, text, strings_type="", sheet_type="", x="1100"):
    """Two collars; `text` is the first one's id, `x` the second one's place."""
    strings = "".join(f"<si><t>{word}</t></si>" for word in ("BHID", "X", "Y", "Z", text, "B"))
    rows = [["s0", "s1", "s2", "s3"], ["s4", "1000", "2000", "50"], ["s5", x, "2000", "51"]]
    cells = "".join(f'<row r="{r + 1}">' + "".join(
        f'<c r="{"ABCD"[c]}{r + 1}"' + (f' t="s"><v>{cell[1:]}' if cell.startswith("s") else f"><v>{cell}") + "</v></c>"
        for c, cell in enumerate(row)) + "</row>" for r, row in enumerate(rows))
    parts = {
        "[Content_Types].xml": f'<Types xmlns="{PACKAGE}/content-types"><Default Extension="rels" ContentType='
        '"application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="xml" ContentType='
        '"application/xml"/>' + "".join(f'<Override PartName="/xl/{part}.xml" ContentType="{TYPES}.{kind}+xml"/>'
                                        for part, kind in (("workbook", "sheet.main"), ("worksheets/sheet1", "worksheet"),
                                                           ("sharedStrings", "sharedStrings"))) + "</Types>",
        "_rels/.rels": relations(("officeDocument", "xl/workbook.xml")),
        "xl/workbook.xml": f'<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}"><sheets><sheet name="collar" sheetId="1" '
        'r:id="rId1"/></sheets></workbook>',
        "xl/_rels/workbook.xml.rels": relations(("worksheet", "worksheets/sheet1.xml"),
                                                ("sharedStrings", "sharedStrings.xml")),
        "xl/sharedStrings.xml": strings_type + f'<sst xmlns="{MAIN}">{strings}</sst>',
        "xl/worksheets/sheet1.xml": sheet_type + f'<worksheet xmlns="{MAIN}"><sheetData>{cells}</sheetData></worksheet>',
    }
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as book:
        for name, content in parts.items():
            book.writestr(name, '<?xml version="1.0" encoding="UTF-8"?>' + content)


class Workbooks(Case):
    def book(self, *arguments, **options):
        path = self.folder / "book.xlsx"
        workbook(path, *arguments, **options)
        return path

    def test_a_plain_one_and_one_with_a_small_entity_are_read(self):
        self.assertIn("rows        2", self.succeed("info", self.book("A")).stdout)
        entity = self.book("&a;", strings_type='<!DOCTYPE sst [<!ENTITY a "KR-1">]>')
        self.assertIn("rows        2", self.succeed("info", entity).stdout)

    def test_bombs_are_refused_and_make_no_values(self):
        for options in ({"strings_type": LAUGH.format("sst"), "text": "&i;"},
                        {"sheet_type": LAUGH.format("worksheet"), "text": "A", "x": "&i;"}):
            text = options.pop("text")
            result = self.run_terratet("info", self.book(text, **options))
            self.assertEqual(result.returncode, 3, result.stdout)
            self.assertRegex(result.stderr, "damaged|corrupted")

    def test_nothing_from_outside_comes_in(self):
        self.write("secret.txt", "the secret")
        for address in ((self.folder / "secret.txt").as_uri(), "http://127.0.0.1:9/x"):
            book = self.book("&a;", strings_type=f'<!DOCTYPE sst [<!ENTITY a SYSTEM "{address}">]>')
            result = self.run_terratet("info", "--json", book)
            self.assertIn(result.returncode, (0, 3))
            self.assertNotIn("secret", result.stdout.replace("secret.txt", ""))


if __name__ == "__main__":
    unittest.main()
