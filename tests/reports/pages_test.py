"""The content of a page: its arrays equal those of the mesh, and file names are only text."""

import collections
import json
import math
import os
import pathlib
import unittest

from program import Page, ProgramTest, read_off


def distance(a, b):
    return math.dist(a, b)


class PagesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.require_pages()

    def smoothed(self, *words):
        self.make("a.off", "icosphere", "--subdivide", "3", "--noise", "0.1")
        self.run_program("smooth", "a.off", "b.off", "--steps", "2", "--report", "p.html", *words)
        return self.page("p.html")

    def assert_at(self, got, expected, tolerance):
        self.assertEqual(len(got), len(expected))
        self.assertLess(max(map(distance, got, expected)), tolerance)

    def test_nothing_of_the_template_is_left(self):
        page = self.smoothed()
        self.assertNotIn("@IBMFAIR_", page.html)
        self.assertEqual(page.scene["bytes_length"], len(page.bytes))
        self.assertEqual(page.report["command"], "smooth")

    def test_both_states_are_the_files(self):
        page = self.smoothed()
        self.assertEqual(page.scene["states"], ["before", "after"])
        self.assertEqual(page.scene["name"], "a.off")
        self.assertIsNone(page.scene["shown"])
        self.assertIsNone(page.scene["arrays"]["patch"])
        for state, name in enumerate(("a.off", "b.off")):
            points, polygons = read_off(self.path(name))
            self.assert_at(page.positions(state), points, 1e-6)
            self.assertEqual(page.triangles(), polygons)
        self.assertEqual(page.scene["state_vertices"], [642, 642])
        self.assertEqual(page.scene["triangles"], [1280, 1280])

    def test_fields_are_those_of_the_states(self):
        page = self.smoothed()
        before, after = page.positions(0), page.positions(1)
        field, moved = page.field("displacement", 1)
        self.assertIsNone(page.field("displacement", 0)[1])
        for got, a, b in zip(moved, before, after):
            self.assertAlmostEqual(got, distance(a, b), delta=3e-4 * got + 1e-6)
        field, rough = page.field("mean_curvature", 0)
        _, smooth = page.field("mean_curvature", 1)
        self.assertTrue(field["diverging"])
        self.assertEqual(field["range"][0], -field["range"][1])
        self.assertLess(max(abs(h - 2) for h in smooth), 0.3 * max(abs(h - 2) for h in rough))
        field, quality = page.field("triangle_quality", 1)
        self.assertEqual(field["on"], "triangle")
        self.assertTrue(all(0 < q <= 1 for q in quality))
        _, density = page.field("energy_density", 1)
        self.assertAlmostEqual(sum(density) / len(density) * page.report["after"]["area"] /
                               page.report["after"]["energy"], 1, delta=0.05)

    def test_far_from_the_origin_no_digit_is_lost(self):
        self.make("near.off", "icosphere", "--subdivide", "2")
        self.make("far.off", "icosphere", "--subdivide", "2", "--move", "1e9,-1e9,1e9")
        for name in ("near", "far"):
            self.run_program("view", f"{name}.off", f"{name}.html")
        near, far = self.page("near.html"), self.page("far.html")
        self.assert_at(far.positions(0), read_off(self.path("far.off"))[0], 3e-7)
        self.assertEqual(far.scene["centre"], [1e9, -1e9, 1e9])
        _, a = near.field("mean_curvature", 0)
        _, b = far.field("mean_curvature", 0)
        self.assertLess(max(abs(x - y) for x, y in zip(a, b)), 1e-2)

    def test_patches_stand_behind_the_mesh(self):
        self.make("open.off", "cylinder", "--rows", "12")
        self.run_program("fill", "open.off", "b.off", "--all", "--report", "p.html")
        page = self.page("p.html")
        before, faces = read_off(self.path("open.off"))
        after, filled = read_off(self.path("b.off"))
        self.assertEqual(page.scene["state_vertices"], [len(before), len(after)])
        self.assertEqual(page.scene["triangles"], [len(faces), len(filled)])
        self.assert_at(page.positions(0), before, 1e-6)
        self.assert_at(page.positions(1), after, 1e-6)
        self.assertEqual(page.triangles(), filled)
        patch = page.array(page.scene["arrays"]["patch"])
        told = [hole["new_triangles"] for hole in page.report["holes"]]
        self.assertEqual(collections.Counter(patch),
                         {0: len(faces), 1: told[0], 2: told[1]})
        kinds = collections.Counter(line["kind"] for line in page.scene["lines"])
        self.assertEqual(kinds["seam"], 2)
        self.assertEqual(kinds["hole"] + kinds["boundary"], 2)
        for line in page.scene["lines"]:
            self.assertEqual(len(line["points"]), 3 * page.report["holes"][line["hole"]]["edges"])
            self.assertTrue(line["closed"])
        moved = page.field("displacement", 1)[1]
        self.assertEqual(sum(map(math.isnan, moved)), len(after) - len(before))
        self.assertGreater(page.report["before"]["boundary_loops"],
                           page.report["after"]["boundary_loops"])

    def test_what_is_held_has_a_border(self):
        self.make("open.off", "plane", "--rows", "12")
        self.run_program("smooth", "open.off", "b.off", "--steps", "1", "--report", "p.html")
        lines = [line for line in self.page("p.html").scene["lines"] if line["kind"] == "held"]
        self.assertEqual(len(lines), 1)  # the second ring along the border
        self.assertTrue(lines[0]["closed"])
        self.run_program("fill", "open.off", "c.off", "--region", "@all", "--report", "c.html", code=0)
        lines = self.page("c.html").scene["lines"]
        self.assertEqual(sum(line["kind"] == "held" for line in lines), 1)

    def test_large_meshes_are_decimated(self):
        self.make("big.ply", "torus", "--rows", "320", "--columns", "400", "--noise", "0.05")
        self.run_program("smooth", "big.ply", "b.ply", "--steps", "1", "--report", "p.html")
        page = self.page("p.html")
        shown = page.scene["shown"]
        self.assertEqual(shown["of"], 256000)
        self.assertEqual(shown["triangles"], len(page.triangles()))
        self.assertTrue(190_000 <= shown["triangles"] <= 200_000)
        self.assertEqual(page.scene["state_vertices"][0], page.scene["state_vertices"][1])
        self.assertEqual(max(map(max, page.triangles())) + 1, page.scene["vertices"])
        for row in page.positions(0)[::97]:  # vertices do not move: on the torus, up to noise
            tube = math.hypot(math.hypot(row[0], row[1]) - 1, row[2])
            self.assertAlmostEqual(tube, math.sqrt(0.5), delta=0.01)
        for field in page.scene["fields"]:
            for place, vertices, triangles in zip(field["values"], page.scene["state_vertices"],
                                                  page.scene["triangles"]):
                if place:
                    expected = vertices if field["on"] == "vertex" else triangles
                    self.assertEqual(place["length"], expected)
                    self.assertFalse(any(map(math.isnan, page.array(place))))

    def test_polygons_keep_their_edges(self):
        self.path("quads.off").write_text(
            "OFF\n6 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n4 0 1 4 3\n4 1 2 5 4\n")
        self.run_program("view", "quads.off", "p.html")
        page = self.page("p.html")
        self.assertEqual(len(page.triangles()), 4)
        edges = set(page.rows(page.scene["arrays"]["edges"], 2))
        self.assertEqual(edges, {(0, 1), (1, 4), (3, 4), (0, 3), (1, 2), (2, 5), (4, 5)})

    def test_unused_vertices_do_not_move_the_centre(self):
        self.path("one.off").write_text("OFF\n4 1 0\n9e9 0 0\n0 0 0\n2 0 0\n0 2 0\n3 1 2 3\n")
        self.run_program("view", "one.off", "p.html")
        page = self.page("p.html")
        self.assertEqual(page.scene["centre"], [1, 1, 0])
        self.assertEqual(page.triangles(), [(0, 1, 2)])
        self.assertTrue(all(map(math.isnan, page.field("mean_curvature", 0)[1])))

    def test_meshes_that_cannot_be_drawn_have_a_page_of_figures(self):
        for scale in ("1e-20", "1e20"):
            self.make("odd.off", "cube", "--scale", scale)
            result = self.run_program("view", "odd.off", "p.html", "--overwrite")
            self.assertIn("shows no mesh", result.stderr.decode())
            page = self.page("p.html")
            self.assertIsNone(page.scene)
            self.assertEqual(page.bytes, b"")
            self.assertEqual(page.report["mesh"]["triangles"], 12)

    def test_view_takes_two_of_equal_connectivity(self):
        self.make("a.off", "icosphere", "--subdivide", "1")
        self.make("b.off", "icosphere", "--subdivide", "1", "--scale", "2")
        self.make("c.off", "icosphere", "--subdivide", "2")
        self.run_program("view", "a.off", "p.html", "--with", "b.off")
        page = self.page("p.html")
        self.assertTrue(all(abs(d - 1) < 0.01 for d in page.field("normal_displacement", 1)[1]))
        self.assertAlmostEqual(page.report["after"]["area"] / page.report["before"]["area"], 4)
        self.run_program("view", "a.off", "q.html", "--with", "c.off", code=4)
        self.run_program("view", "a.off", "q.txt", code=2)
        self.run_program("view", "a.off", "p.html", code=6)
        self.assertFalse(self.path("q.html").exists())

    def test_warnings_have_places(self):
        self.path("bad.off").write_text(
            "OFF\n5 3 0\n0 0 0\n2 0 0\n1 1 0\n1 -1 0\n1 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n")
        self.run_program("view", "bad.off", "p.html")
        page = self.page("p.html")
        places = page.scene["places"]
        told = [w for w in page.report["warnings"] if "place" in w]
        self.assertEqual([w["place"] for w in told], list(range(len(places))))
        for warning, place in zip(told, places):
            self.assertEqual(warning["element"], place["title"])
            self.assertEqual([a + c for a, c in zip(place["at"], page.scene["centre"])],
                             warning["at"])
        self.assertIn("defect", [line["kind"] for line in page.scene["lines"]])

    def test_hostile_names_are_only_text(self):
        names = ("</script><script>alert(1)</script>.off", "<!--<script>.off", "\"'>&lt;<b>.off",
                 "\x1b[31m\u202e\u2028.off", "@IBMFAIR_SCENE@ @IBMFAIR_BYTES@.off")
        self.make("a.off", "cube")
        for i, name in enumerate((*names, b"a\xff\xfe.off")):
            path = os.fsdecode(name) if isinstance(name, bytes) else name
            with self.subTest(name=name):
                (self.folder / path.replace("/", "\u2215")).write_bytes(
                    self.path("a.off").read_bytes())
                file = path.replace("/", "\u2215")
                self.run_program("view", file, f"{i}.html")
                page = self.page(f"{i}.html")
                text = page.script("report") + page.script("scene")
                self.assertNotIn("<", text)
                self.assertFalse(any(ord(c) < 32 and c != "\n" for c in text))
                shown = os.fsencode(file).decode("utf-8", "replace")
                self.assertEqual(page.scene["name"], shown)
                self.assertEqual(page.report["input"], shown)
                self.assertEqual(len(page.triangles()), 12)

    def test_a_batch_links_to_the_pages_of_its_items(self):
        self.make("a.off", "icosphere", "--subdivide", "1")
        self.make("b.off", "icosphere", "--subdivide", "1")
        self.path("bad.off").write_text("OFF\n1 1 0\n0 0 0\n3 0 1 2\n")
        self.path("pages").mkdir()
        self.path("sub").mkdir()
        self.run_program("smooth", "a.off", "b.off", "bad.off", "--out-dir", "fair", "--steps", "1",
                         "--report", "pages/{stem}.html", "--report", "{stem}.json", "--summary",
                         "sub/../pages/all.html", "--summary", "all.json", code=1)
        page = self.page("pages/all.html")
        self.assertIsNone(page.scene)
        items = page.report["items"]
        self.assertEqual([item.get("page") for item in items], ["a.html", "b.html", None])
        for item, name in zip(items, ("a", "b")):
            self.assertEqual(self.page(f"pages/{item['page']}").scene["name"], f"{name}.off")
        listed = json.loads(self.path("all.json").read_text())["items"]
        self.assertEqual([item.get("page") for item in listed],
                         ["pages/a.html", "pages/b.html", None])
        self.assertEqual(json.loads(self.path("a.json").read_text())["status"], "completed")

    def test_failures_leave_no_page(self):
        self.make("a.off", "cube")
        result = self.run_program("view", "a.off", "none/p.html", code=6)
        self.assertIn("none/p.html", result.stderr.decode())
        self.path("full.html").symlink_to("/dev/full")
        result = self.run_program("view", "a.off", "full.html", "--overwrite", code=6)
        self.assertIn("No space left", result.stderr.decode())
        self.run_program("smooth", "a.off", "b.off", "--report", "p.html", "--report",
                         str(pathlib.Path("x/../p.html")), code=2)
        self.assertFalse(self.path("p.html").exists())

    def test_equal_meshes_give_equal_scenes(self):
        self.make("a.off", "torus", "--noise", "0.1")
        pages = []
        for threads in ("1", "2"):
            self.run_program("view", "a.off", f"{threads}.html", "--threads", threads)
            pages.append(self.page(f"{threads}.html"))
        self.assertEqual(pages[0].scene, pages[1].scene)
        self.assertEqual(pages[0].script("bytes"), pages[1].script("bytes"))


if __name__ == "__main__":
    unittest.main()
