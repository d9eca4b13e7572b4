"""The files that --report writes, and the names that --report rejects before any computation."""

import csv
import io
import json
import unittest

from program import ProgramTest

quick = ("--steps", "3", "--cutoff", "4")


class FormatsTest(ProgramTest):
    def rows(self, name):
        text = self.path(name).read_bytes().decode()
        self.assertTrue(text.endswith("\r\n"))
        return list(csv.DictReader(io.StringIO(text, newline=""), strict=True))

    def test_several_reports_of_one_run_agree(self):
        self.make("a.off", "icosphere", "--subdivide", "2", "--noise", "0.1")
        told = self.json("smooth", "a.off", "b.off", *quick, "--report", "r.json", "--report",
                         "r.csv")
        self.assertEqual(json.loads(self.path("r.json").read_text()), told)
        rows = self.rows("r.csv")
        self.assertEqual(len(rows), len(told["steps"]))
        for row, step in zip(rows, told["steps"]):
            self.assertEqual(list(row), list(step))
            self.assertEqual(float(row["energy"]), step["energy"])
            self.assertEqual(row["refactored"], json.dumps(step["refactored"]))
        self.assertEqual(told["arguments"]["steps"], 3)
        self.assertEqual(told["arguments"]["laplacian"], "crouzeix-raviart")
        self.assertEqual(told["arguments"]["report"], ["r.json", "r.csv"])
        self.assertFalse(told["arguments"]["plain"])
        self.assertIn("Eigen", [c["name"] for c in told["components"]])

    def test_tables_have_a_line_for_each_hole_and_file(self):
        self.make("open.off", "cylinder", "--rows", "6")
        self.make("ball.off", "icosphere", "--subdivide", "1")
        self.run_program("fill", "open.off", "b.off", "--only", "1", "--report", "holes.csv")
        rows = self.rows("holes.csv")
        self.assertEqual([row["status"] for row in rows], ["skipped", "filled"])
        self.assertEqual(rows[0]["fairing.energy_after"], "")
        self.assertGreater(float(rows[1]["fairing.energy_after"]), 0)
        self.run_program("holes", "open.off", "--report", "list.csv")
        self.assertEqual([row["edges"] for row in self.rows("list.csv")],
                         [row["edges"] for row in rows])
        self.run_program("info", "ball.off", "--report", "info.csv")
        self.assertEqual([row["vertices"] for row in self.rows("info.csv")], ["42"])
        self.run_program("smooth", "open.off", "ball.off", "--out-dir", "out", "--steps", "1",
                         "--report", "{stem}.csv", "--summary", "all.csv", "--summary", "all.json")
        self.assertEqual([row["input"] for row in self.rows("all.csv")], ["open.off", "ball.off"])
        self.assertEqual(len(json.loads(self.path("all.json").read_text())["items"]), 2)
        self.assertEqual(len(self.rows("ball.csv")), 1)

    def test_no_steps_leave_the_names_of_the_columns(self):
        self.make("a.off", "cube")
        self.run_program("smooth", "a.off", "b.off", "--steps", "0", "--report", "r.csv")
        self.assertTrue(self.path("r.csv").read_text().startswith("step,time,"))
        self.assertEqual(self.rows("r.csv"), [])

    def test_batch_reports_on_its_items(self):
        self.make("a.off", "cube", "--subdivide", "2")
        job = {"command": "smooth", "input": "a.off", "output": "b.off",
               "options": {"steps": 1, "report": ["{stem}.csv", "{stem}-1.json"]}}
        self.path("jobs.json").write_text(json.dumps({"jobs": [job]}))
        self.run_program("batch", "jobs.json", "--report", "r.json", "--report", "r.csv")
        self.assertEqual(json.loads(self.path("r.json").read_text())["items"][0]["status"], "ok")
        self.assertEqual(self.rows("r.csv")[0]["status"], "ok")
        told = json.loads(self.path("a-1.json").read_text())
        self.assertEqual(told["command"], "smooth")
        self.assertEqual(len(self.rows("a.csv")), len(told["steps"]))

    def test_what_cannot_be_written_is_refused_before_the_work(self):
        self.make("a.off", "icosphere", "--subdivide", "2")
        self.path("there.json").write_text("old")
        smooth = ("smooth", "a.off", "b.json", "--format", "off", *quick)
        cases = (
            (("--report", "r.txt"), 2, ".json, .csv, .html"),
            (("--report", "r.json", "--report", "./r.json"), 2, "already"),
            (("--report", "b.json"), 2, "the output already"),
            (("--report", "r", "--picture", "r"), 2, "already"),
            (("--picture", "r.jpg"), 2, ".png"),
            (("--report", "there.json"), 6, "exists"),
            (("--report", "none/r.csv"), 6, "none/r.csv"),
        )
        for words, code, text in cases:
            with self.subTest(words=words):
                result = self.run_program(*smooth, *words, code=code)
                self.assertIn(text, result.stderr.decode())
                self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                                 ["a.off", "there.json"])
        self.assertEqual(self.path("there.json").read_text(), "old")
        self.run_program(*smooth, "--report", "there.json", "--overwrite")
        self.assertIn("steps", json.loads(self.path("there.json").read_text()))

    def test_a_name_without_an_ending_is_json(self):
        self.make("a.off", "cube")
        self.run_program("info", "a.off", "--report", "report")
        self.assertEqual(json.loads(self.path("report").read_text())["vertices"], 8)
        told = self.run_program("smooth", "a.off", "b.off", "--steps", "1", "--report", "-").stdout
        self.assertEqual(json.loads(told)["command"], "smooth")
        self.run_program("smooth", "a.off", "-", "--report", "-", code=2)

    def test_a_full_disk_is_told(self):
        self.make("a.off", "cube")
        result = self.run_program("info", "a.off", "--report", "/dev/full", code=6)
        self.assertIn("No space left", result.stderr.decode())

    def test_warnings_say_where(self):
        self.path("bad.off").write_text(
            "OFF\n5 3 0\n0 0 0\n2 0 0\n1 1 0\n1 -1 0\n1 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n")
        warnings = self.json("smooth", "bad.off", "b.off")["warnings"]
        self.assertIn("left out of the energy", warnings[0]["text"])
        self.assertEqual(warnings[1]["element"], "edge 0-1 has three or more triangles")
        self.assertEqual(warnings[1]["place"], 0)
        self.assertEqual(warnings[1]["at"], [1, 0, 0])
        self.assertAlmostEqual(warnings[1]["radius"], 1)
        self.assertIn("no vertex is free", warnings[-1]["text"])


if __name__ == "__main__":
    unittest.main()
