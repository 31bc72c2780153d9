# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages say what the program says: help in docs/commands, commands of the tutorial, the README's program.

TERRATET_UPDATE_DOCS=1 writes the help into the pages instead of comparing."""
import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

from terratet import PROGRAM, ROOT, Case, twin_inputs

DOCS = ROOT / "docs"


class Documents(Case):
    def commands(self):
        lines = self.succeed("help").stdout.split("Commands:\n")[1].splitlines()
        return [line.split()[0] for line in lines if re.match(r"  [a-z]", line)]

    def test_each_command_has_a_page_with_its_help(self):
        pages = {page.stem for page in (DOCS / "commands").glob("*.md")}
        self.assertEqual(pages, set(self.commands()))
        for command in sorted(pages - {"help"}):
            help_text = self.succeed(command, "--help").stdout
            self.compare_block(DOCS / "commands" / f"{command}.md", help_text)
        self.compare_block(DOCS / "commands" / "help.md", self.succeed("help").stdout)

    def compare_block(self, page, text):
        pattern = re.compile(r"(```text\n).*?(```)", re.S)
        found = pattern.search(page.read_text())
        self.assertTrue(found, f"{page}: no help")
        if os.environ.get("TERRATET_UPDATE_DOCS"):
            page.write_text(pattern.sub(lambda m: m[1] + text + m[2], page.read_text(), count=1))
        self.assertEqual(pattern.search(page.read_text())[0], "```text\n" + text + "```", f"{page} is out of date")

    def test_the_tutorials_commands_run(self):
        (self.folder / "data").symlink_to(ROOT / "data")
        environment = {**os.environ, "PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"}
        blocks = re.findall(r"```console\n(.*?)```", (DOCS / "tutorial.md").read_text(), re.S)
        self.assertGreater(len(blocks), 4)
        for block in blocks:
            script = re.sub(r"^\$ ", "", block, flags=re.M)
            result = subprocess.run(["bash", "-euc", script], cwd=self.folder, env=environment, capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, script + result.stderr)

    def test_what_the_page_of_outputs_says_to_type_runs(self):
        self.succeed("build", *twin_inputs(), "-o", "site.gpkg")
        environment = {**os.environ, "PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"}
        rows = re.findall(r"^\| [^|]+ \| `(terratet [^`]+)` \|$", (DOCS / "outputs.md").read_text(), re.M)
        self.assertGreater(len(rows), 12)
        for row in rows:
            result = subprocess.run(["bash", "-euc", row + " --overwrite"], cwd=self.folder, env=environment,
                                    capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, row + result.stderr)
            if "--dry-run" not in row:
                for name in row.split("site.gpkg ")[1].split():
                    self.assertGreater((self.folder / name.split(",of=")[0]).stat().st_size, 0, row)

    def test_the_papers_experiment_gives_the_figures_of_its_page(self):
        page = (DOCS / "olkiluoto.md").read_text("utf-8")
        command = re.search(r"^    (terratet convert.*?twin\.csv)$", page, re.S | re.M)[1]
        options = shlex.split(command.replace("\\\n", " "))[2:]
        policy = options[options.index("--density"):options.index("--report")]
        for name in ("collar.csv", "survey.csv", "log.csv", "fracture.ts"):
            (self.folder / name).symlink_to(ROOT / "data" / "olkiluoto-twin" / name)
        columns = {}
        for column, given in ((3, options), (4, [word for word in options if word not in policy])):
            self.succeed("convert", "--overwrite", *given)
            columns[column] = json.loads((self.folder / "report.json").read_text())
        for row, figures in {
            "borehole samples kept": lambda r: [r["preprocess"]["samples_kept"]],
            "vertices on the domain": lambda r: [r["preprocess"]["domain_vertices"]],
            "initial vertices": lambda r: [r["initial"]["vertices"], r["initial"]["tetrahedra"]],
            "skinny / flat at first": lambda r: [r["initial"]["skinny_percent"], r["initial"]["flat_percent"]],
            "vertices inserted": lambda r: [r["refine"]["inserted"]],
            "final vertices": lambda r: [r["final"]["vertices"], r["final"]["tetrahedra"]],
            "skinny / flat in the end": lambda r: [r["final"]["skinny_percent"], r["final"]["flat_percent"]],
            "smallest dihedral": lambda r: [r["final"]["dihedral_deg"]["min"], r["final"]["dihedral_deg"]["p1"]],
            "edges across": lambda r: [r["final"]["fault_crossing_edges"]],
            "linear field": lambda r: [r["fidelity"]["K"]["rms"]],
        }.items():
            cells = next(line for line in page.splitlines() if line.startswith("| " + row)).split("|")
            for column, report in columns.items():
                said = re.findall(r"\d[\d\u00a0 ]*\.?\d*", cells[column].replace("1 %", ""))
                numbers = [re.sub(r"\s", "", text) for text in said]
                places = [len(text.partition(".")[2]) for text in numbers]
                found = [f"{value:.{digits}f}" for value, digits in zip(figures(report), places)]
                self.assertEqual(numbers, found, (row, column))

    def test_the_readmes_program_is_the_one_that_the_install_test_builds(self):
        program = re.search(r"```cpp\n(.*?)```", (ROOT / "README.md").read_text(), re.S)[1]
        tested = (ROOT / "tests" / "install" / "first_model.cpp").read_text()
        self.assertTrue(tested.endswith(program), "README.md and tests/install/first_model.cpp differ")

    def test_links_between_pages_lead_somewhere(self):
        for page in [*ROOT.glob("*.md"), *DOCS.rglob("*.md"), *(ROOT / "data").rglob("*.md")]:
            prose = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", prose):
                self.assertTrue((page.parent / target).exists(), f"{page}: {target}")


if __name__ == "__main__":
    unittest.main()
