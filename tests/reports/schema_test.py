"""Reports of every command match data/report.schema.json, and all its fields occur in reports."""

import json
import math
import os
import pathlib
import sys
import unittest

from program import ProgramTest, data, program

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not there")
    sys.exit(77)

schema = json.loads((data / "report.schema.json").read_text())


def fields_in(value, path=""):
    """The names of all fields of a report, including those of nested objects and lists."""
    if isinstance(value, dict):
        for name, part in value.items():
            yield name
            yield from fields_in(part)
    elif isinstance(value, list):
        for part in value:
            yield from fields_in(part)


def described_fields(part):
    if isinstance(part, dict):
        for name, value in part.get("properties", {}).items():
            yield name
        for value in part.values():
            yield from described_fields(value)
    elif isinstance(part, list):
        for value in part:
            yield from described_fields(value)


class SchemaTest(ProgramTest):
    def cut(self, source, target, middle, radius):
        """Cuts a hole of this radius into an OFF file of triangles."""
        lines = self.path(source).read_text().splitlines()
        vertices, faces = map(int, lines[1].split()[:2])
        X = [list(map(float, line.split())) for line in lines[2:2 + vertices]]
        kept = [line for line in lines[2 + vertices:2 + vertices + faces]
                if math.dist([sum(x) / 3 for x in zip(*(X[int(v)] for v in line.split()[1:]))],
                             middle) > radius]
        self.path(target).write_text("\n".join(
            ["OFF", f"{vertices} {len(kept)} 0", *lines[2:2 + vertices], *kept, ""]))

    def cut_ring(self, name, cut):
        """Leaves out the triangles of an OFF file at vertices near the plane y = 0 with x > 0."""
        lines = self.path(name).read_text().splitlines()
        vertices = int(lines[1].split()[0])
        places = [[float(x) for x in line.split()] for line in lines[2:2 + vertices]]
        kept = [line for line in lines[2 + vertices:] if not any(
            places[int(v)][0] > 0 and abs(places[int(v)][1]) < 0.3 for v in line.split()[1:])]
        self.path(cut).write_text("\n".join(
            ["OFF", f"{vertices} {len(kept)} 0", *lines[2:2 + vertices], *kept, ""]))

    def reports(self):
        """One report of each kind, including the optional fields."""
        self.make("ball.off", "icosphere", "--subdivide", "2", "--noise", "0.2")
        self.make("open.off", "cylinder", "--rows", "6")
        self.path("defects.off").write_text(
            "OFF\n6 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n2 0 0\n"
            "3 0 1 2\n3 1 0 3\n3 0 1 4\n3 0 1 5\n3 2 2 1\n")
        quick = ("--steps", "2", "--cutoff", "4", "--overwrite")
        yield self.json("smooth", "ball.off", "out.off", *quick)
        yield self.json("smooth", "ball.off", "out.off", "--plain", "--steps", "0", "--overwrite")
        yield self.json("smooth", "ball.off", "out.off", "--solver", "cg", *quick)
        yield self.json("smooth", "defects.off", "out.off", *quick)
        if pathlib.Path(program).with_name("ibmfair-petsc").exists():
            os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
            yield self.json("smooth", "ball.off", "out.off", "--engine", "petsc", *quick)
        yield self.json("smooth", "ball.off", "out.off", "--cutoff", "auto", "--overwrite")
        self.make("cube.off", "cube", "--subdivide", "4", "--noise", "0.1")
        yield self.json("smooth", "cube.off", "out.off", "--denoise", "--overwrite")
        lines = self.path("cube.off").read_text().splitlines()
        lines[100] = "9 9 9"
        self.path("outlier.off").write_text("\n".join([*lines, ""]))
        yield self.json("smooth", "outlier.off", "out.off", "--denoise", "--overwrite")
        yield self.json("smooth", "outlier.off", "dry.off", "--denoise", "--dry-run")
        self.make("rough_ball.off", "icosphere", "--subdivide", "4", "--noise", "0.5")
        yield self.json("smooth", "rough_ball.off", "half.off", "--cutoff", "2", "--overwrite")
        yield self.json("smooth", "half.off", "out.off", "--denoise", "--overwrite")
        yield self.json("smooth", "ball.off", "dry.off", "--dry-run")
        yield self.json("fill", "open.off", "out.off", "--all", "--overwrite")
        yield self.json("fill", "open.off", "out.off", "--overwrite")
        yield self.json("fill", "open.off", "out.off", "--all", "--max-new-vertices", "1",
                        "--overwrite", code=1)
        self.make("torus.off", "torus", "--columns", "24")
        self.cut_ring("torus.off", "ring.off")
        yield self.json("fill", "ring.off", "out.off", "--bridge", "0,1", "--overwrite")
        yield self.json("fill", "open.off", "out.off", "--region", "@all", "--overwrite")
        self.make("rough.off", "cylinder", "--rows", "30", "--noise", "0.2")
        yield self.json("fill", "rough.off", "out.off", "--all", "--overwrite")
        fin = pathlib.Path(__file__).parents[1] / "fill" / "reported" / "fin_at_rim.off"
        yield self.json("fill", fin, "out.off", "--overwrite")
        self.make("box.off", "cube", "--subdivide", "3")
        self.cut("box.off", "holed.off", (1, 1, 0), 0.3)
        yield self.json("fill", "holed.off", "out.off", "--keep-sharp", "30", "--overwrite")
        yield self.json("holes", "open.off")
        self.path("nearly_welded.off").write_text(
            "OFF\n8 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n1 1e-7 0\n0 1 0\n0 0 1\n"
            "3 0 2 1\n3 0 1 3\n3 4 7 6\n3 5 6 7\n")
        yield self.json("holes", "nearly_welded.off")
        yield self.json("fill", "nearly_welded.off", "out.off", "--stitch", "--overwrite")
        self.path("slit.off").write_text(
            "OFF\n7 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 .01 1\n0 0 -1\n0 -.01 1\n"
            "3 0 2 4\n3 2 1 4\n3 1 3 6\n3 3 0 6\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")
        yield self.json("holes", "slit.off")
        yield self.json("info", "ball.off", "--sphere")
        yield self.json("info", "ball.off", "--laplacian", "lagrange", "--mass", "voronoi")
        yield self.json("info", "defects.off")
        yield self.json("info", "nearly_welded.off")
        self.path("odd.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nt 1//4 2 3\nf 1 2 3\nF 1 2 3\n")
        odd = self.json("info", "odd.obj")
        self.assertEqual(odd["unknown_statements"],
                         {"count": 2, "first_line": 4, "first_keyword": "t"})
        self.assertIn("odd.obj:4:1: unknown keyword 't'", odd["warnings"][0]["text"])
        yield odd
        yield self.json("compare", "ball.off", "ball.off", "--tolerance", "1")
        yield self.json("compare", "ball.off", "open.off")
        yield self.json("compare", "ball.off", "--sphere", "fit")
        yield self.json("smooth", "ball.off", "open.off", "--out-dir", "fair", "--steps", "1",
                        "--report", "{stem}.json")
        self.path("jobs.json").write_text(json.dumps({"jobs": [
            {"command": "info", "input": "ball.off"},
            {"command": "smooth", "input": "open.off", "output": "fair/open.off"}]}))
        yield self.json("batch", "jobs.json", "--keep-going", code=1)

    def pages(self):
        self.require_pages()
        self.run_program("fill", "open.off", "out.off", "--all", "--report", "fill.html",
                         "--report", "fill.json", "--overwrite")
        yield json.loads(self.path("fill.json").read_text())
        for words in ((), ("--with", "out.off")):
            self.run_program("smooth", "ball.off", "out.off", "--steps", "1", "--overwrite")
            self.run_program("view", "ball.off", "view.html", *words, "--overwrite", "--report",
                             "view.json")
            yield json.loads(self.path("view.json").read_text())
        self.run_program("smooth", "ball.off", "--out-dir", "pages", "--steps", "1", "--report",
                         "pages/{stem}.html", "--summary", "all.json")
        yield json.loads(self.path("all.json").read_text())

    def validate(self, reports):
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        seen = set()
        for report in reports:
            with self.subTest(command=report["command"], arguments=report["arguments"]):
                error = jsonschema.exceptions.best_match(validator.iter_errors(report))
                self.assertIsNone(error, error and f"{error.json_path}: {error.message}")
            seen.update(fields_in(report))
        return seen

    def test_every_report_is_as_described(self):
        seen = self.validate(self.reports())
        for name in ("place", "element", "decrease_ratio", "relative_deviation", "solvers"):
            self.assertIn(name, seen)

    def test_every_described_field_is_in_some_report(self):
        seen = self.validate(self.reports()) | self.validate(self.pages())
        self.assertEqual(sorted(set(described_fields(schema)) - seen), [])

    def test_every_field_has_a_description(self):
        def check(part, path):
            if isinstance(part, dict):
                for name, value in part.get("properties", {}).items():
                    described = {**value, **schema["$defs"].get(
                        value.get("$ref", "").removeprefix("#/$defs/"), {}), **value}
                    self.assertTrue(described.get("description") or "const" in described,
                                    f"{path}.{name}")
                for key, value in part.items():
                    check(value, f"{path}.{key}")

        check(schema["$defs"], "")

    def test_wrong_reports_are_refused(self):
        validator = jsonschema.Draft202012Validator(schema)
        self.make("ball.off", "icosphere")
        right = self.json("info", "ball.off")
        self.assertTrue(validator.is_valid(right))
        for change in ({"version": 2}, {"area": "1"}, {"new": 1}, {"components": None}):
            self.assertFalse(validator.is_valid({**right, **change}), change)
        for name in right:
            if name != "sphere":
                rest = {key: value for key, value in right.items() if key != name}
                self.assertFalse(validator.is_valid(rest), name)


if __name__ == "__main__":
    unittest.main()
