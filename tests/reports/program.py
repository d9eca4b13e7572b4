"""Runs the real program in a folder of the test's own, and reads the files that it writes."""

import base64
import gzip
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

program = os.environ["IBMFAIR"]
data = pathlib.Path(__file__).parents[2] / "data"
codes = {"float32": "f", "uint32": "I", "uint8": "B"}


class Page:
    """The data in a report page, read as a browser would read them."""

    def __init__(self, html):
        self.html = html
        self.report = json.loads(self.script("report"))
        self.scene = json.loads(self.script("scene"))
        packed = base64.b64decode(self.script("bytes"), validate=True)
        self.bytes = gzip.decompress(packed) if packed else b""

    def script(self, name):
        """The text of the script element with this id, up to the end tag seen by a browser."""
        found = re.findall(f'<script id="{name}"[^>]*>(.*?)</script', self.html, re.S | re.I)
        assert len(found) == 1, f"{len(found)} scripts called {name}"
        return found[0].strip()

    def array(self, place):
        code = codes[place["type"]]
        assert place["offset"] % 4 == 0
        return struct.unpack_from(f"<{place['length']}{code}", self.bytes, place["offset"])

    def rows(self, place, size):
        values = self.array(place)
        return [values[i : i + size] for i in range(0, len(values), size)]

    def triangles(self):
        return self.rows(self.scene["arrays"]["triangles"], 3)

    def positions(self, state):
        """Vertex positions of a state in the coordinates of the mesh."""
        centre = self.scene["centre"]
        place = self.scene["arrays"]["positions"][state]
        return [[x + c for x, c in zip(row, centre)] for row in self.rows(place, 3)]

    def field(self, name, state):
        field = next(f for f in self.scene["fields"] if f["name"] == name)
        place = field["values"][state]
        return field, None if place is None else self.array(place)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *words, code=0):
        """Runs the program in the folder; the exit code must be `code`."""
        result = subprocess.run([program, *map(str, words)], cwd=self.folder, capture_output=True,
                                timeout=600)
        self.assertEqual(result.returncode, code, result.stderr)
        return result

    def json(self, *words, code=0):
        return json.loads(self.run_program(*words, "--json", code=code).stdout)

    def make(self, name, *words):
        self.run_program("make", words[0], name, *words[1:], "--overwrite")
        return name

    def path(self, name):
        return self.folder / name

    def page(self, name):
        return Page(self.path(name).read_text("utf-8"))

    def require_pages(self):
        """Skips the test if this build has no report page."""
        self.make("tiny.off", "cube")
        result = subprocess.run([program, "view", "tiny.off", "tiny.html"], cwd=self.folder,
                                capture_output=True)
        if b"no report page" in result.stderr:
            self.skipTest("this build has no report page")


def read_off(path):
    """Vertices and faces of a plain OFF file."""
    words = pathlib.Path(path).read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    numbers = list(map(float, words[4 : 4 + 3 * vertices]))
    points = [numbers[i : i + 3] for i in range(0, len(numbers), 3)]
    rest = words[4 + 3 * vertices :]
    polygons = []
    for _ in range(faces):
        count = int(rest[0])
        polygons.append(tuple(map(int, rest[1 : 1 + count])))
        rest = rest[1 + count :]
    return points, polygons
