# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live session: lines and HTTP, the client of docs/live.md, and its what-if."""
import http.client
import json
import queue
import re
import shlex
import shutil
import subprocess
import threading
import unittest
import urllib.parse

from terratet import PROGRAM, ROOT, TWIN, Case

PAGE = (ROOT / "docs" / "live.md").read_text()
CLIENT = re.search(r"```python\n(.*?)```", PAGE, re.S).group(1)


class Live(Case):
    def setUp(self):
        super().setUp()
        rows = [f"{x},{y},{z},{x + y - z}" for x in (10, 60, 90, 160) for y in (10, 100, 190) for z in (-90, -50, -10)]
        self.write("s.csv", "x,y,z,v\n" + "\n".join(rows) + "\n")
        self.write("collar.csv", "id,x,y,z\nA,50,50,0\n")
        self.write("log.csv", "id,depth,v\n" + "".join(f"A,{d},{d}\n" for d in range(10, 60, 20)))
        self.succeed("build", "--samples", "s.csv", "--boreholes", "collar.csv", "--log", "log.csv", "-s_srs", "local", "-te", 0, 0, -100, 200, 200, 0,
                     "--lmin", 20, "-o", "m.gpkg", "-q")

    def lines(self, *requests):
        text = "".join((r if isinstance(r, str) else json.dumps(r)) + "\n" for r in requests)
        done = subprocess.run([PROGRAM, "live", "m.gpkg"], cwd=self.folder, input=text, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_lines_are_answered_in_order_and_edits_are_stored(self):
        digest = self.succeed("info", "m.gpkg", "--digest").stdout
        answers = self.lines({"id": 1, "query": ["nearest", "--at", "50,50,-10", "-k", "2"]},
                             {"id": 2, "edit": ["move-borehole", "A", "--by", "5,0,0"]},
                             {"id": "three", "query": ["nearest", "--at", "50,50,-10", "-k", "2"]},
                             {"id": 4, "edit": ["move-borehole", "B", "--by", "5,0,0"]}, "no json", {"id": 5},
                             {"id": 6, "edit": ["move-borehole", "A", "--by", "-5,1,0"], "dry_run": True},
                             {"id": 7, "export": ["m.vtu"]}, {"id": 8, "edit": ["history"]}, {"id": 9, "edit": ["undo"]},
                             {"id": 10, "section": ["--plane", "0,0,-50,0,0,1"]})
        self.assertEqual([a["id"] for a in answers], [1, 2, "three", 4, None, 5, 6, 7, 8, 9, 10])
        self.assertEqual([a["ok"] for a in answers], [True, True, True, False, False, False, True, True, True, True, True])
        by_id = {a["id"]: a for a in answers}
        self.assertEqual(by_id[1]["result"]["rows"][0][2:6], [50, 50, -10, 0])
        self.assertEqual(by_id["three"]["result"]["rows"][0][5], 5)
        self.assertEqual(by_id[2]["result"]["edit"], 1)
        self.assertIn("there is A", by_id[4]["error"])
        self.assertIsNone(by_id[6]["result"]["edit"])
        self.assertGreater(by_id[7]["result"]["outputs"][0]["bytes"], 1000)
        self.assertEqual(len(by_id[8]["result"]["history"]), 2)
        for polygon in by_id[10]["result"]["polygons"]:
            for corner in polygon:
                self.assertAlmostEqual(corner[2], -50, 9)
        self.assertEqual(self.succeed("info", "m.gpkg", "--digest").stdout, digest)

    def test_a_subscriber_can_follow_the_cells(self):
        cells = {}

        def state():
            self.succeed("export", "m.gpkg", "v.csv", "--overwrite", "-q")
            return sorted(int(line.split(",")[3]) for line in (self.folder / "v.csv").read_text().splitlines()[1:])

        before = set(state())
        answers = self.lines({"id": 1, "subscribe": True}, {"id": 2, "edit": ["move-borehole", "A", "--by", "5,0,0"]},
                             {"id": 3, "edit": ["set-resolution", "0,0,-100,50,50,0=10,40"]})
        events = [a for a in answers if a.get("event") == "change"]
        self.assertEqual([e["edit"] for e in events], [1, 2])
        for event in events:
            before -= set(event["vertices"]["removed"])
            before |= {v["id"] for v in event["vertices"]["added"]}
            for cell in event["cells"]["removed"]:
                cells[tuple(cell)] = cells.get(tuple(cell), 0) - 1
            for cell in event["cells"]["added"]:
                cells[tuple(cell)] = cells.get(tuple(cell), 0) + 1
        self.assertEqual(before, set(state()))
        self.assertLessEqual(set(cells.values()), {-1, 0, 1})

    def test_the_client_of_the_page_edits_asks_and_follows_while_others_are_kept_out(self):
        space = {}
        exec(compile(CLIENT, "docs/live.md", "exec"), space)
        live = space["Live"](PROGRAM, str(self.folder / "m.gpkg"))
        self.addCleanup(live.process.stdout.close)
        self.addCleanup(live.close)
        events = queue.Queue()
        live.follow(events.put)
        place = urllib.parse.urlparse(live.url)

        def status(path=place.path, host=None, origin=None, method="POST"):
            connection = http.client.HTTPConnection("127.0.0.1", place.port, timeout=30)
            headers = {"Host": host or f"127.0.0.1:{place.port}", **({"Origin": origin} if origin else {})}
            connection.request(method, path, body='{"id": 1, "query": ["region"]}' if method == "POST" else None, headers=headers)
            answer = connection.getresponse()
            answer.read()
            connection.close()
            return answer.status

        self.assertEqual(status(), 200)
        self.assertEqual(status(origin=f"http://localhost:{place.port}", host=f"localhost:{place.port}"), 200)
        self.assertEqual(status(path="/"), 404)
        self.assertEqual(status(path="/" + "0" * 32 + "/"), 404)
        self.assertEqual(status(host="evil.example"), 403)
        self.assertEqual(status(origin="https://evil.example"), 403)
        self.assertEqual(status(origin="null"), 403)
        self.assertEqual(status(method="GET"), 200)

        volume = live.ask(query=["region"])["rows"][0][1]
        self.assertAlmostEqual(volume / (200 * 200 * 100), 1, 9)
        with self.assertRaisesRegex(RuntimeError, "there is A"):
            live.ask(edit=["remove-borehole", "Z"])
        done, answers = threading.Event(), []

        def ask_on():
            while not done.is_set():
                answers.append(live.ask(query=["nearest", "--at", "50,50,-10"])["rows"][0][5])

        reader = threading.Thread(target=ask_on)
        reader.start()
        result = live.ask(edit=["move-borehole", "A", "--by", "5,0,0"])
        done.set()
        reader.join()
        self.assertLessEqual(set(answers), {0, 5})
        self.assertEqual(result["edit"], 1)
        event = events.get(timeout=30)
        self.assertEqual(event["edit"], 1)
        self.assertEqual(len(event["vertices"]["removed"]), result["vertices"]["removed"])

    def test_the_what_if_of_the_page_ends_where_it_began(self):
        for name in ("collar.csv", "survey.csv", "log.csv", "fracture.ts"):
            shutil.copy(TWIN / name, self.folder)
        self.write("line.csv", "x,y,z\n525200,6792300,0\n525800,6791700,0\n")
        commands = [line for line in re.search(r"```\n(terratet build.*?)```", PAGE, re.S).group(1).splitlines() if line]
        self.assertEqual(len(commands), 10)
        digests = []
        for command in commands:
            self.succeed(*shlex.split(command)[1:])
            digests.append(self.succeed("info", "site.gpkg", "--digest").stdout)
        self.assertEqual(digests[0], digests[-1])
        self.assertEqual(len(set(digests)), 3)
        for pair in ("with.png", "without.png"), ("with.tif", "without.tif"):
            first, second = ((self.folder / name).read_bytes() for name in pair)
            self.assertNotEqual(first, second)
        for picture in re.findall(r"images/live-(with(?:out)?\.png)", PAGE):
            self.assertEqual((ROOT / "docs" / "images" / f"live-{picture}").read_bytes()[:24],  # its size among them
                             (self.folder / picture).read_bytes()[:24])


if __name__ == "__main__":
    unittest.main()
