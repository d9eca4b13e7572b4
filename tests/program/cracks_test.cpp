// Cracks as users meet them: `holes` and `fill` name them, say which option closes them, and
// `--weld LENGTH` and `fill --stitch` do.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/formats.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/cracked_meshes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class Cracks : public testing::Test {
 protected:
  std::string file(const Mesh& mesh, const std::string& name) {
    write_mesh(mesh, directory_ / name, {.overwrite = true});
    return directory_ / name;
  }

  std::string out(const std::string& name) const { return directory_ / name; }

  static json parsed(const RunResult& run) { return json::parse(run.out, nullptr, false); }

  json holes(const std::string& path, const Words& options = {}) {
    return parsed(run_program(Words{"holes", path, "--json"} + options));
  }

  json fill(const std::string& in, const std::string& to, const Words& options, int exit_code = 0) {
    const RunResult run = run_program(Words{"fill", in, to, "--json", "--overwrite"} + options);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    messages_ = run.err;
    return parsed(run);
  }

  TemporaryDirectory directory_;
  std::string messages_;
};

/// Expects a closed surface like `whole`: no holes and no defects, the same topology and area.
void expect_closed(const Mesh& mesh, const Mesh& whole, double tolerance = 1e-9) {
  const State state(mesh), before(whole);
  EXPECT_TRUE(state.topology.boundary_loops.empty());
  EXPECT_TRUE(state.topology.defects.empty()) << state.topology.defects.count();
  EXPECT_EQ(state.topology.component_count, before.topology.component_count);
  EXPECT_EQ(state.topology.euler_characteristic(), before.topology.euler_characteristic());
  const double area = surface_area(before.X, before.topology.F);
  EXPECT_NEAR(surface_area(state.X, state.topology.F), area, tolerance * area);
}

/// Coarse closed meshes of triangles.
std::vector<NamedMesh> coarse_meshes() {
  std::vector<NamedMesh> meshes;
  for (const auto& [name, mesh] : closed_meshes()) {
    if (name == "tetrahedron" || name == "octahedron" || name == "torus") {
      meshes.push_back({name, in_triangles(mesh)});
    }
  }
  meshes.push_back({"icosahedron", sphere(0)});
  return meshes;
}

const std::vector<std::vector<Index>> uneven_parts{{1, 2}, {1, 3}, {2, 3}, {1, 2, 3, 4, 5}};

TEST_F(Cracks, StitchingClosesUnevenlyCutSurfacesWithoutNewVertices) {
  unsigned seed = 0;
  for (const Placement placement : all_placements) {
    for (const auto& [name, mesh] : placed(coarse_meshes(), placement)) {
      for (const std::vector<Index>& parts : uneven_parts) {
        SCOPED_TRACE(fmt::format("{} in {} parts, seed {}", name, fmt::join(parts, " or "), seed));
        const Mesh cut = unevenly_cut(mesh, parts, ++seed);
        const std::string in = file(cut, "in.obj"), to = out("out.obj");
        const json report = fill(in, to, {"--stitch"});
        EXPECT_EQ(report["new_triangles"], 0);
        const Mesh closed = read_mesh(to).mesh();
        EXPECT_EQ(closed.X, cut.X);
        expect_closed(closed, mesh);
      }
    }
  }
}

TEST_F(Cracks, EveryFormatCanBeStitched) {
  const Mesh mesh = in_triangles(sphere(1));
  const Mesh cut = unevenly_cut(mesh, {1, 2, 3}, 5);
  for (const std::string name : {"in.obj", "in.off", "in.ply", "in.stl"}) {
    SCOPED_TRACE(name);
    const std::string in = file(cut, name);
    for (const std::string to : {"out.obj", "out.off", "out.ply", "out.stl"}) {
      fill(in, out(to), {"--stitch"});
      expect_closed(read_mesh(out(to)).mesh(), mesh, 1e-6);  // STL holds float32
    }
    const RunResult piped = run_program({"fill", in, "-", "--stitch"});
    EXPECT_EQ(piped.exit_code, 0) << piped.err;
    write_bytes(out("piped" + name), piped.out);
    EXPECT_EQ(read_mesh(out("piped" + name)).format().extensions.front(), name.substr(3));
  }
}

TEST_F(Cracks, PolygonsStayPolygonsOrBecomeTrianglesWithArea) {
  for (const std::vector<Index>& parts : uneven_parts) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Mesh cut = unevenly_cut_cube(parts, seed);
      const std::string in = file(cut, "in.off");
      fill(in, out("out.off"), {"--stitch"});
      const Mesh closed = read_mesh(out("out.off")).mesh();
      EXPECT_EQ(closed.X, cut.X);
      expect_closed(closed, closed_meshes()[2].mesh);
    }
  }
}

TEST_F(Cracks, FacesApartAreMergedAndStitched) {
  for (const auto& [name, mesh] : coarse_meshes()) {
    SCOPED_TRACE(name);
    const Mesh cut = unevenly_cut(mesh, {1, 2, 3}, 7);
    fill(file(apart(cut), "in.ply"), out("out.ply"), {"--stitch"});
    const Mesh closed = read_mesh(out("out.ply")).mesh();
    EXPECT_EQ(closed.X.rows(), cut.X.rows());
    expect_closed(closed, mesh);
  }
}

TEST_F(Cracks, HolesBesideCracksAreFilled) {
  for (const auto& [name, mesh] : coarse_meshes()) {
    SCOPED_TRACE(name);
    const Mesh cut = unevenly_cut(mesh, {2, 3}, 11);
    const Mesh open = without_triangles(cut, {1, cut.faces.size() - 1});
    const json report = fill(file(open, "in.ply"), out("out.ply"), {"--stitch"});
    EXPECT_GE(report["holes"].size(), 1u);
    EXPECT_GT(report["stitched"]["t_junctions"], 0);
    const Mesh closed = read_mesh(out("out.ply")).mesh();
    EXPECT_EQ(closed.X.topRows(open.X.rows()), open.X);
    EXPECT_TRUE(State(closed).topology.boundary_loops.empty());
    EXPECT_TRUE(State(closed).topology.defects.empty());
  }
}

/// The law of every hint: the option that it names leaves as many holes as it says.
TEST_F(Cracks, WhatIsSaidToBeLeftIsLeft) {
  std::vector<NamedMesh> meshes;
  for (const auto& [name, mesh] : coarse_meshes()) {
    meshes.push_back({name + " apart", apart(mesh)});
    meshes.push_back({name + " in two", cut_in_two(mesh)});
    const Mesh cut = unevenly_cut(mesh, {1, 2}, 3);
    meshes.push_back({name + " cut", cut});
    meshes.push_back({name + " cut, a face missing", without_triangles(cut, {3})});
    meshes.push_back({name + " cut and apart", apart(cut)});
  }
  meshes.push_back({"sphere nearly in two", cut_in_two(sphere(2), 1e-5)});
  meshes.push_back({"sphere with a slit", with_slit(sphere(2), 100, 0.01)});
  meshes.push_back({"sphere with a slit around it", cut_in_two(sphere(2), 0.01)});
  Mesh two_levels = unevenly_cut(sphere(2), {1, 2}, 4);
  two_levels.X.rowwise().normalize();
  meshes.push_back({"sphere of two levels of detail", two_levels});
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const std::string in = file(mesh, "in.ply");
    const json cracks = holes(in)["cracks"];
    EXPECT_GT(cracks["cracks"].get<int>() + cracks["partial_cracks"].get<int>() +
                  cracks["slits"].get<int>(),
              0);
    const auto left = [&](const Words& options) {
      const json listed = holes(in, options)["holes"];
      return std::ranges::count_if(listed, [](const json& hole) { return !hole["outer_border"]; });
    };
    if (cracks.contains("after_weld")) {
      EXPECT_EQ(cracks["after_weld"]["holes"], left({"--weld"}));
    }
    if (cracks.contains("after_weld_within_tolerance")) {
      EXPECT_EQ(cracks["after_weld_within_tolerance"]["holes"],
                left({fmt::format("--weld={}u", cracks["weld_tolerance"].get<double>())}));
    }
    if (cracks.contains("after_stitch")) {
      fill(in, out("stitched.ply"), {"--stitch", "--max-edges", "1"});
      EXPECT_EQ(cracks["after_stitch"]["boundary_loops"],
                holes(out("stitched.ply"))["holes"].size());
    }
    if (cracks.contains("after_stitch_within_reach")) {
      const double reach = cracks["stitch_reach"];
      fill(in, out("stitched.ply"), {"--stitch", fmt::format("{}u", reach), "--max-edges", "1"});
      EXPECT_EQ(cracks["after_stitch_within_reach"]["boundary_loops"],
                holes(out("stitched.ply"))["holes"].size());
    }
  }
}

TEST_F(Cracks, KindsOfLoops) {
  const auto kinds = [&](const Mesh& mesh) {
    std::vector<std::string> all;
    const json listed = holes(file(mesh, "in.off"))["holes"];
    for (const json& hole : listed) {
      all.push_back(hole["kind"]);
    }
    return all;
  };
  using Kinds = std::vector<std::string>;
  EXPECT_EQ(kinds(without_cap(sphere(3), 30)), Kinds{"hole"});
  EXPECT_EQ(kinds(cut_in_two(sphere(2))), (Kinds{"crack", "crack"}));
  EXPECT_EQ(kinds(cut_in_two(sphere(2), 1e-5)), (Kinds{"crack", "crack"}));
  EXPECT_EQ(kinds(cut_in_two(sphere(2), 0.01)), (Kinds{"slit", "slit"}));
  EXPECT_EQ(kinds(cut_in_two(sphere(2), 0.3)), (Kinds{"hole", "hole"}));
  EXPECT_EQ(kinds(with_slit(sphere(2), 100, 0.01)), Kinds{"slit"});
  EXPECT_EQ(kinds(with_slit(sphere(2), 100, 0.1)), Kinds{"hole"});
  // The two sides of a ribbon are as close to each other, but the mesh lies between them.
  Mesh ribbon = flat_sheet(20, 1);
  ribbon.X.col(1) *= 1e-3;
  EXPECT_EQ(kinds(ribbon), Kinds{"hole"});
  // A corner that only touches an edge closes nothing by splitting it.
  Mesh touching;
  touching.X.resize(6, 3);
  touching.X << 0, 0, 0, 2, 0, 0, 1, 2, 0, 1, 0, 0, .5, -1, 1, 1.5, -1, 1;
  touching.faces.add(std::array<Index, 3>{0, 1, 2});
  touching.faces.add(std::array<Index, 3>{3, 4, 5});
  EXPECT_EQ(kinds(touching), (Kinds{"hole", "hole"}));
  EXPECT_EQ(holes(file(touching, "in.off"))["cracks"]["t_junctions"], 0);
}

TEST_F(Cracks, AReportedTJunctionIsClosed) {
  const std::string in = project_file("tests/fill/reported/tjunction.off");
  const json named = holes(in);
  ASSERT_EQ(named["holes"].size(), 1u);
  EXPECT_EQ(named["holes"][0]["kind"], "crack");
  EXPECT_EQ(named["cracks"]["t_junctions"], 1);
  fill(in, out("open.off"), {}, 1);
  EXPECT_NE(messages_.find("1 T-junction"), std::string::npos) << messages_;
  EXPECT_NE(messages_.find("with `fill --stitch` no hole is left"), std::string::npos) << messages_;
  fill(in, out("closed.off"), {"--stitch"});
  const Mesh before = read_mesh(in).mesh(), after = read_mesh(out("closed.off")).mesh();
  EXPECT_EQ(after.X, before.X);
  EXPECT_TRUE(State(after).topology.boundary_loops.empty());
  EXPECT_TRUE(State(after).topology.defects.empty());
}

TEST_F(Cracks, WeldingTakesALengthOnlyIfTheNextWordIsOne) {
  const std::string in = file(cut_in_two(sphere(2), 1e-4), "in.off");
  const auto vertices = [&](const Words& words) {
    const RunResult run = run_program(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return parsed(run)["vertices"];
  };
  const int apart = vertices({"info", in, "--json"}), whole = sphere(2).X.rows();
  EXPECT_GT(apart, whole);
  EXPECT_EQ(vertices({"info", "--weld", in, "--json"}), apart);
  EXPECT_EQ(vertices({"info", in, "--json", "--weld"}), apart);
  for (const std::string length : {"2e-4u", "2e-4", "0.001e", "0.01%"}) {
    EXPECT_EQ(vertices({"info", "--weld", length, in, "--json"}), whole) << length;
    EXPECT_EQ(vertices({"info", "--weld=" + length, in, "--json"}), whole) << length;
  }
  EXPECT_EQ(vertices({"info", "--weld", "1e-5u", in, "--json"}), apart);
  const RunResult wrong = run_program({"info", "--weld=near", in});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("--weld"), std::string::npos) << wrong.err;
}

TEST_F(Cracks, ABatchTakesTheLengthToo) {
  const std::string in = file(cut_in_two(sphere(2), 1e-4), "in.off");
  for (const std::string length : {"2e-4u", "0.001"}) {
    const RunResult job = run_program(
        {"fill", in, out("out.off"), "--stitch", "--overwrite", "--weld", length, "--dump-config"});
    EXPECT_EQ(job.exit_code, 0) << job.err;
    const json options = parsed(job)["jobs"][0]["options"];
    EXPECT_EQ(options["stitch"], true);
    EXPECT_EQ(
        options["weld"].is_string() ? options["weld"].get<std::string>() : options["weld"].dump(),
        length);
    write_bytes(out("jobs.json"), job.out);
    const RunResult batch = run_program({"batch", out("jobs.json"), "--overwrite"});
    EXPECT_EQ(batch.exit_code, 0) << batch.err;
    EXPECT_EQ(read_mesh(out("out.off")).mesh().X.rows(), sphere(2).X.rows());
  }
  const RunResult many =
      run_program({"fill", in, "--out-dir", out("many"), "--weld=2e-4u", "--stitch"});
  EXPECT_EQ(many.exit_code, 0) << many.err;
  EXPECT_EQ(read_mesh(out("many/in.off")).mesh().X.rows(), sphere(2).X.rows());
  EXPECT_EQ(holes(out("many/in.off"))["holes"].size(), 0u);
}

TEST_F(Cracks, WeldingWithinALengthSaysWhatCollapses) {
  const std::string in = file(sphere(2), "in.off");
  const RunResult run = run_program({"info", in, "--weld", "0.2u", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const RunResult all = run_program({"info", in, "--weld", "5u"});
  EXPECT_EQ(all.exit_code, 4) << all.err;
  EXPECT_NE(all.err.find("no face is left"), std::string::npos) << all.err;

  // One edge of a sphere is made short. Welding takes it out with its two triangles.
  Mesh mesh = sphere(2);
  const Index a = mesh.faces[7][0], b = mesh.faces[7][1];
  mesh.X.row(b) = mesh.X.row(a) + 1e-3 * (mesh.X.row(b) - mesh.X.row(a));
  const std::string edge = file(mesh, "edge.off");
  const RunResult one = run_program({"info", edge, "--weld", "0.001u", "--json"});
  EXPECT_NE(one.err.find("1 edge was shorter"), std::string::npos) << one.err;
  EXPECT_NE(one.err.find("2 faces were left out"), std::string::npos) << one.err;
  EXPECT_EQ(parsed(one)["faces"], mesh.faces.size() - 2);
  EXPECT_EQ(parsed(one)["closed"], true);
  EXPECT_EQ(parsed(one)["defects"]["repeated_corner_triangles"].size(), 0u);
}

TEST_F(Cracks, SmoothingAndInfoPointToWelding) {
  const std::string in = file(apart(sphere(2)), "in.ply");
  const RunResult smooth = run_program({"smooth", in, out("out.ply")});
  EXPECT_NE(smooth.err.find("--weld merges such vertices"), std::string::npos) << smooth.err;
  const RunResult welded = run_program({"smooth", in, out("welded.ply"), "--weld"});
  EXPECT_EQ(welded.err.find("--weld"), std::string::npos) << welded.err;
  const json info = parsed(run_program({"info", in, "--json"}));
  EXPECT_EQ(info["coincident_vertices"], 3 * sphere(2).faces.size() - sphere(2).X.rows());
  EXPECT_EQ(info["after_weld"]["components"], 1);
  EXPECT_EQ(info["after_weld"]["closed"], true);
  const json whole = parsed(run_program({"info", in, "--weld", "--json"}));
  EXPECT_EQ(whole["coincident_vertices"], 0);
  EXPECT_TRUE(whole["after_weld"].is_null());
}

}  // namespace
}  // namespace ibmfair::test
