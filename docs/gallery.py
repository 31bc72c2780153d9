# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of docs/gallery.md, of docs/live.md, and the README's, from the twin of Olkiluoto in data/:

    TERRATET=build/release/tools/terratet python3 -B docs/gallery.py [NAME]...

Each is what the command beside it writes, but for the page's, which a headless Chromium takes."""
import csv
import math
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
TWIN = ROOT / "data" / "olkiluoto-twin"
IMAGES = ROOT / "docs" / "images"
PROGRAM = os.environ.get("TERRATET", "terratet")
EXTENT = ["-te", "525130", "6791500", "-990", "525870", "6792500", "10"]
HOLES = ["--boreholes", TWIN / "collar.csv", "--survey", TWIN / "survey.csv", "-s_srs", "EPSG:3067", *EXTENT]
SIZE = ["--size", "1120,700"]


def run(folder, *arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, check=True)


def twin(folder):
    """The model that most are of."""
    if not (folder / "twin.gpkg").exists():
        run(folder, "build", "-q", *HOLES, "--log", TWIN / "log.csv", "--faults", TWIN / "fracture.ts", "--property",
            "K:log10:unit=m/s", "--lmin", "20m", "--lmax", "80m", "--df-max", "K=1", "--uncertainty", "-o", "twin.gpkg")
    return "twin.gpkg"


def fracture(folder, picture):
    run(folder, "export", "-q", *SIZE, "--iso", "K=1e-9", twin(folder), picture)


def readme(folder, picture):
    run(folder, "export", "-q", *SIZE, "--iso", "K=1e-9", twin(folder), "Olkiluoto twin.png")
    (folder / "Olkiluoto twin.png").rename(folder / picture)


def page(folder, picture):
    run(folder, "export", "-q", twin(folder), "Olkiluoto twin.html")  # a name becomes the title
    profile = folder / "profile"
    address = (folder / "Olkiluoto twin.html").as_uri() + "#hole=OT-02&cutOn=1&cut=1e-9&isoOn=0&pick=525500,6792000,-300"
    subprocess.run([shutil.which("chromium") or "chromium-browser", "--headless", "--no-sandbox", "--use-gl=angle",
                    "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", f"--user-data-dir={profile}",
                    "--window-size=1100,680", "--virtual-time-budget=30000", f"--screenshot={folder / picture}", address],
                   check=True, stderr=subprocess.DEVNULL)


def what_if(folder, of):
    """The commands of docs/live.md make its two pictures."""
    if not (folder / of).exists():
        for name in ("collar.csv", "survey.csv", "log.csv", "fracture.ts"):
            shutil.copy(TWIN / name, folder)
        (folder / "line.csv").write_text("x,y,z\n525200,6792300,0\n525800,6791700,0\n")
        page = (ROOT / "docs" / "live.md").read_text()
        for command in re.search(r"```\n(terratet build.*?)```", page, re.S).group(1).splitlines():
            run(folder, *shlex.split(command)[1:])
    return folder / of


def live_with(folder, picture):
    what_if(folder, "with.png").rename(folder / picture)


def live_without(folder, picture):
    what_if(folder, "without.png").rename(folder / picture)


def levels(folder, picture):
    run(folder, "export", "-q", *SIZE, "--section", "z=-150", "--section", "z=-450", "--section", "z=-750", "--iso", "K=3e-10",
        "--color-map", "cividis", twin(folder), picture)


def reach(folder, picture):
    run(folder, "export", "-q", *SIZE, "--max-extrapolation", "0.2", "--color-map", "plasma", "--section", "z=-600",
        "--section", "90,525500,6792000", "--section", "525500,6792000,525500,6792500", "--iso", "K=1e-9", twin(folder), picture)


def rocks(folder, picture):
    """Classes from the twin's conductivities, and the ground over them."""
    names = ((-11.6, "tight"), (-10.6, "middling"), (math.inf, "leaky"))
    with open(TWIN / "log.csv", newline="") as source, open(folder / "rock.csv", "w", newline="") as out:
        reader = csv.DictReader(source)
        writer = csv.writer(out)
        value = reader.fieldnames[-1]
        writer.writerow([*reader.fieldnames[:-1], "rock"])
        for row in reader:
            rock = next(name for limit, name in names if math.log10(float(row[value])) < limit)
            writer.writerow([*(row[name] for name in reader.fieldnames[:-1]), rock])
    rows = [" ".join(f"{-25 + 22 * math.sin(i / 6) * math.cos(j / 7):.2f}" for i in range(60)) for j in range(70)]
    (folder / "ground.asc").write_text("ncols 60\nnrows 70\nxllcorner 525050\nyllcorner 6791400\ncellsize 16\n" + "\n".join(rows) + "\n")
    run(folder, "convert", "-q", *HOLES, "--log", "rock.csv", "--property", "rock:categorical", "--topography", "ground.asc",
        "--lmin", "25m", "--estimator", "idw", *SIZE, picture)


def blocks(folder, picture):
    """Faults alone."""
    rows = ["x,y,z,fault"]
    for name, strike, dip, east in (("west", 20, 70, 525330), ("east", 340, 65, 525660)):
        s, d = math.radians(strike), math.radians(dip)
        for along in range(-900, 901, 60):
            for down in range(-900, 901, 60):
                rows.append("%.2f,%.2f,%.2f,%s" % (east + along * math.sin(s) + down * math.cos(d) * math.cos(s),
                                                   6792000 + along * math.cos(s) - down * math.cos(d) * math.sin(s),
                                                   -490 - down * math.sin(d), name))
    (folder / "faults.csv").write_text("\n".join(rows) + "\n")
    run(folder, "convert", "-q", "--faults", "faults.csv", "-s_srs", "EPSG:3067", *EXTENT, "--lmin", "40m", *SIZE,
        "--section", "z=-490", "--section", "90,525500,6792000", picture)


def main(names):
    pictures = {"readme": readme, "fracture": fracture, "page": page, "levels": levels, "reach": reach, "rocks": rocks, "blocks": blocks,
                "live-with": live_with, "live-without": live_without}
    with tempfile.TemporaryDirectory(prefix="terratet gallery ") as scratch:
        folder = pathlib.Path(scratch)
        for name in names or pictures:
            pictures[name](folder, f"{name}.png")
            own = {"readme": "olkiluoto-twin.png", "live-with": "live-with.png", "live-without": "live-without.png"}
            target = IMAGES / own.get(name, f"gallery-{name}.png")
            shutil.copy(folder / f"{name}.png", target)
            print(f"{target.name}: {target.stat().st_size} bytes")


if __name__ == "__main__":
    main(sys.argv[1:])
