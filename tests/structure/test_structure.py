# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of the house, read from the includes: floors and rooms, lowest first. A file may include what lies at the top of
its own floor or of one below, and in rooms that are not above its own; what is installed includes only what is installed."""
import collections
import pathlib
import re
import statistics
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FLOORS = {
    "tess": ["base", "site", "mesh", "barrier/complex", "barrier/query", "barrier/seeds", "barrier/prepare", "model",
             "refine", "cells", "mending", "collapse", "voronoi", "edit"],
    "interp": ["base", "ranks", "estimator", "sites", "natural", "kriging", "plan", "voxels", "live"],
    "io": ["base", "read/tables", "read/meshes", "read/surfaces", "read/logs", "read", "read/site", "style", "model", "edit",
           "voxels", "voxels/tiles", "voxels/grids", "write", "write/scene", "write/tiles", "onto"],
    "tools": ["options", "run", "report", "commands"],
}
LONGEST_FILE, LARGEST_ROOM, MEDIAN_FILE, LONGEST_LINE = 450, 4500, 110, 120


def stem(path):
    """One operation, one stem: a header at a floor's top and its source in a room are one."""
    return path.parts[0] + ":" + path.name.split(".")[0]


class House:
    def __init__(self, root, floors):
        self.root, self.floors = root, floors
        self.lines, self.includes = {}, {}
        for floor in floors:
            for path in sorted((root / floor).rglob("*.[ch]pp")):
                text = path.read_text()
                name = path.relative_to(root)
                self.lines[name] = text.count("\n")
                self.includes[name] = [pathlib.PurePath(found) for found in re.findall(r'^#include "([^"]+)"', text, re.M)
                                       if found.split("/")[0] in floors]
        self.room_of_stem = {stem(path): self.room(path) for path in self.lines if self.room(path) != ""}

    @staticmethod
    def room(path):
        return "/".join(path.parts[1:-1])

    def level(self, path):
        """A header at the top is as high as the room its source lies in, or as what it includes."""
        floor = path.parts[0]
        room = self.room(path) or self.room_of_stem.get(stem(path))
        if room is not None:
            return self.floors[floor].index(room) if room in self.floors[floor] else None
        below = [self.level(other) for other in self.includes.get(path, []) if other.parts[0] == floor]
        return max([-1, *(level for level in below if level is not None)])

    def faults(self, public=None):
        """Each in a sentence."""
        found = []
        order = list(self.floors)
        for path, includes in self.includes.items():
            floor = path.parts[0]
            if self.room(path) and self.room(path) not in self.floors[floor]:
                found.append(f"{path} is in no room of the plan")
                continue
            if not self.room(path) and path.suffix == ".cpp" and floor != "tools":
                found.append(f"{path} is at the floor's top, where only what is installed lies")
            for other in includes:
                if other not in self.lines and (self.root / f'{other}.in').exists():
                    continue  # made by the build
                if other not in self.lines:
                    found.append(f"{path} includes {other}, which is not there")
                elif order.index(other.parts[0]) > order.index(floor):
                    found.append(f"{path} includes {other} from a floor above")
                elif other.parts[0] == floor and self.level(other) > self.level(path):
                    found.append(f"{path} includes {other} from a room above")
                elif self.room(path) == "" and self.room(other) != "" and path.suffix == ".hpp":
                    found.append(f"{path} is installed and includes {other}, which is not")
        found += self.circles()
        for path in public or []:
            if self.room(path):
                found.append(f"{path} is installed, but lies in a room")
        if public is not None:
            found += [f"{path} lies at the top, but is not installed" for path in self.lines
                      if path.suffix == ".hpp" and not self.room(path) and path.parts[0] != "tools" and path not in public]
        return found

    def circles(self):
        next_ = collections.defaultdict(set)
        for path, includes in self.includes.items():
            next_[stem(path)] |= {stem(other) for other in includes} - {stem(path)}
        found, state = [], {}

        def visit(one, way):
            state[one] = "open"
            for other in sorted(next_[one]):
                if state.get(other) == "open":
                    found.append("a circle of stems: " + " -> ".join([*way[way.index(other):], other]))
                elif other not in state:
                    visit(other, [*way, other])
            state[one] = "done"

        for one in sorted(next_):
            if one not in state:
                visit(one, [one])
        return found

    def rooms(self):
        sizes = collections.Counter()
        for path, lines in self.lines.items():
            sizes[path.parts[0] + "/" + self.room(path)] += lines
        return sizes


def installed(root):
    """The headers that the floors' CMake files list."""
    public = set()
    for floor in FLOORS:
        text = (root / floor / "CMakeLists.txt").read_text()
        listed = re.search(r"\bHEADERS\b(.*?)\b(PUBLIC|PRIVATE)\b", text, re.S)
        public |= {pathlib.PurePath(floor, name) for name in (listed.group(1).split() if listed else [])}
    return public


def long_lines(name, text):
    """Those of code and prose. In Markdown a table's row, an example and a link cannot be broken."""
    found, example = [], False
    for number, line in enumerate(text.splitlines(), 1):
        example ^= line.lstrip().startswith("```")
        whole = name.endswith(".md") and (example or re.match(r"\s*\||    |\s*(\S+ )?\S*\]\(\S+\)\S*$", line))
        if len(line) > LONGEST_LINE and not whole:
            found.append(f"{name}:{number}: {len(line)} characters")
    return found


class Structure(unittest.TestCase):
    house = House(ROOT, FLOORS)

    def test_arrows_point_down_no_circle_and_only_the_top_is_installed(self):
        self.assertEqual(self.house.faults(installed(ROOT)), [])

    def test_files_and_rooms_are_small(self):
        lines = self.house.lines
        self.assertEqual([f"{path}: {n}" for path, n in lines.items() if n > LONGEST_FILE], [])
        self.assertEqual([f"{room}: {n}" for room, n in self.house.rooms().items() if n > LARGEST_ROOM], [])
        self.assertLessEqual(statistics.median(lines.values()), MEDIAN_FILE)

    def test_the_page_on_the_design_names_every_room_and_only_files_that_are_there(self):
        page = (ROOT / "docs" / "design.md").read_text("utf-8")
        rows = {row.split("`")[1]: row for row in page.splitlines() if row.startswith("| `")}
        self.assertEqual([f"{floor}/{room}" for floor, rooms in FLOORS.items() for room in rooms
                          if f"`{room}`" not in rows[floor]], [])
        named = re.findall(r"\b(?:tess|interp|io|tools)/[\w/]+\.[ch]pp\b", page)
        self.assertGreater(len(named), 15)
        self.assertEqual([name for name in named if not (ROOT / name).exists()], [])

    def test_lines_end_at_120_characters(self):
        files = [path for folder in [*FLOORS, "tests"] for path in (ROOT / folder).rglob("*.[ch]pp")]
        files += [*ROOT.glob("docs/*.md"), ROOT / "CONTRIBUTING.md", *ROOT.glob("data/*/README.md")]  # not docs/commands: made
        long = [found for path in sorted(files) for found in long_lines(str(path.relative_to(ROOT)), path.read_text("utf-8"))]
        self.assertEqual(long, [])


class FindsLongLines(unittest.TestCase):
    def test_in_code_and_in_prose_by_characters(self):
        self.assertEqual(long_lines("a.cpp", "é" * 120 + "\n" + "// |" + "x" * 120), ["a.cpp:2: 124 characters"])
        self.assertEqual(long_lines("a.md", "word " * 30), ["a.md:1: 150 characters"])

    def test_but_not_in_tables_examples_and_links(self):
        text = "\n".join(["| " + "x " * 80, "```", "$ " + "x " * 80, "```", "    " + "x " * 80,
                          "* [words](https://" + "x" * 130 + ")"])
        self.assertEqual(long_lines("a.md", text), [])


def options_named(text):
    """In string literals of a source. What is behind // is none, unless a literal holds the slashes."""
    literals = re.findall(r'"(?:[^"\\\n]|\\.)*"|//.*', text)
    return [name for literal in literals if literal[0] == '"' for name in re.findall(r"(?<![\w-])--[a-z][a-z-]*", literal)]


class LibraryNamesItsFields(unittest.TestCase):
    """Below tools there is no command line: messages name fields, in backticks, and tools knows the options."""

    def test_no_string_of_the_library_names_an_option(self):
        self.assertEqual([f"{path}: {name}" for floor in ("tess", "interp", "io")
                          for path in sorted((ROOT / floor).rglob("*.[ch]pp"))
                          for name in options_named(path.read_text())], [])

    def test_reads_literals_only(self):
        self.assertEqual(options_named('throw Error("raise --l-min, or"\n    "--pad");  // "--extent"\n--count;\n'),
                         ["--l-min", "--pad"])
        self.assertEqual(options_named('"a \\" --of"; x = "http://y"; z("(--strict)")'), ["--of", "--strict"])
        self.assertEqual(options_named('"`l_min`, a--b, 1--2"; y = i--;'), [])


class ReadsTheIncludes(unittest.TestCase):
    """The reader itself, on houses with one fault each."""

    def faults(self, files, public=None):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            house = House(pathlib.Path(folder), {"low": ["cellar", "kitchen"], "high": ["attic"]})
            return house.faults(None if public is None else {pathlib.PurePath(name) for name in public})

    def test_a_sound_house(self):
        self.assertEqual(self.faults({"low/value.hpp": "", "low/kitchen/value.cpp": '#include "low/cellar/coal.hpp"\n',
                                      "low/cellar/coal.hpp": "", "high/attic/box.cpp": '#include "low/value.hpp"\n'},
                                     ["low/value.hpp"]), [])

    def test_an_arrow_up(self):
        above = self.faults({"low/cellar/coal.hpp": '#include "high/attic/box.hpp"\n', "high/attic/box.hpp": ""})
        self.assertEqual(above, ["low/cellar/coal.hpp includes high/attic/box.hpp from a floor above"])
        room = self.faults({"low/cellar/coal.hpp": '#include "low/kitchen/stove.hpp"\n', "low/kitchen/stove.hpp": ""})
        self.assertEqual(room, ["low/cellar/coal.hpp includes low/kitchen/stove.hpp from a room above"])
        top = self.faults({"low/cellar/coal.cpp": '#include "low/value.hpp"\n', "low/value.hpp": "",
                           "low/kitchen/value.cpp": '#include "low/value.hpp"\n'})
        self.assertEqual(top, ["low/cellar/coal.cpp includes low/value.hpp from a room above"])

    def test_a_circle_of_stems(self):
        self.assertEqual(self.faults({"low/cellar/a.cpp": '#include "low/cellar/b.hpp"\n', "low/cellar/a.hpp": "",
                                      "low/cellar/b.hpp": '#include "low/cellar/a.hpp"\n'}),
                         ["a circle of stems: low:a -> low:b -> low:a"])

    def test_what_is_installed(self):
        files = {"low/value.hpp": '#include "low/cellar/coal.hpp"\n', "low/cellar/coal.hpp": ""}
        self.assertEqual(self.faults(files), ["low/value.hpp is installed and includes low/cellar/coal.hpp, which is not"])
        self.assertEqual(self.faults({"low/cellar/coal.hpp": ""}, ["low/cellar/coal.hpp"]),
                         ["low/cellar/coal.hpp is installed, but lies in a room"])
        self.assertEqual(self.faults({"low/value.hpp": ""}, []), ["low/value.hpp lies at the top, but is not installed"])


if __name__ == "__main__":
    unittest.main()
