// `ibmfair fill` and `ibmfair holes` as their users run them.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class FillProgram : public testing::Test {
 protected:
  /// Writes the mesh and returns its path.
  std::string file(const Mesh& mesh, const std::string& name) {
    write_mesh(mesh, directory_ / name);
    return directory_ / name;
  }

  std::string out(const std::string& name) const { return directory_ / name; }

  static json report(const RunResult& run) { return json::parse(run.out, nullptr, false); }

  static Topology topology(const std::string& path) {
    const Mesh mesh = read_mesh(path).mesh();
    return build_topology(mesh.X, triangulate(mesh).F);
  }

  TemporaryDirectory directory_;
};

TEST_F(FillProgram, ListsHoles) {
  const std::string in = file(without_triangles(sphere(2), {0, 100}), "in.off");
  const RunResult text = run_program({"holes", in});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("perimeter"), std::string::npos);
  const json holes = report(run_program({"holes", in, "--json"}))["holes"];
  ASSERT_EQ(holes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(holes[i]["id"], i);
    EXPECT_EQ(holes[i]["edges"], 3);
    EXPECT_EQ(holes[i]["vertices"].size(), 3u);
    EXPECT_EQ(holes[i]["simple"], true);
    EXPECT_EQ(holes[i]["outer_border"], false);
  }
  const RunResult closed = run_program({"holes", file(sphere(1), "closed.off")});
  EXPECT_EQ(closed.exit_code, 0);
  EXPECT_EQ(closed.out, "");
}

TEST_F(FillProgram, ClosesAScanAndLeavesItsBytesAlone) {
  const std::string in = file(without_cap(sphere(3), 50), "in.obj");
  const RunResult run = run_program({"fill", in, out("out.obj"), "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json told = report(run);
  ASSERT_EQ(told["holes"].size(), 1u);
  const json& hole = told["holes"][0];
  EXPECT_EQ(hole["status"], "filled");
  EXPECT_EQ(hole["folded_hinges"], 0);
  EXPECT_EQ(hole["intersections"], 0);
  EXPECT_LT(hole["fairing"]["energy_after"], hole["fairing"]["energy_before"]);
  EXPECT_LT(hole["fairing"]["normal_gradient_ratio"], 1e-3);
  EXPECT_LT(hole["seam_degrees"]["median"],
            1.5 * hole["surroundings_degrees"]["median"].get<double>());
  EXPECT_GT(hole["new_vertices"], 20);
  const std::string before = read_bytes(in), after = read_bytes(out("out.obj"));
  EXPECT_EQ(after.substr(0, before.size()), before);
  const Topology closed = topology(out("out.obj"));
  EXPECT_TRUE(closed.boundary_loops.empty());
  EXPECT_TRUE(closed.defects.empty());
}

TEST_F(FillProgram, FillsOnlyWhatIsAskedFor) {
  const std::string in = file(without_triangles(sphere(2), {0, 100}), "in.ply");
  EXPECT_EQ(run_program({"fill", in, out("one.ply"), "--only", "1"}).exit_code, 0);
  EXPECT_EQ(topology(out("one.ply")).boundary_loops.size(), 1u);
  EXPECT_EQ(run_program({"fill", in, out("none.ply"), "--max-edges", "2"}).exit_code, 0);
  EXPECT_EQ(read_bytes(out("none.ply")), read_bytes(in));
  const RunResult unknown = run_program({"fill", in, out("x.ply"), "--only", "0,7"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("no hole 7"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out("x.ply")));
}

TEST_F(FillProgram, LeavesTheOuterBorderUnlessAsked) {
  const std::string in = file(with_square_hole(flat_sheet(8, 8), 3), "in.off");
  const RunResult run = run_program({"fill", in, out("out.off")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("outer border"), std::string::npos);
  EXPECT_EQ(topology(out("out.off")).boundary_loops.size(), 1u);

  const std::string sheet = file(flat_sheet(8, 8), "sheet.off");
  const RunResult open = run_program({"fill", sheet, out("open.off")});
  EXPECT_EQ(open.exit_code, 0) << open.err;
  EXPECT_NE(open.err.find("--all fills them"), std::string::npos) << open.err;
}

TEST_F(FillProgram, WhatIsNotAchievedGivesExitCodeOne) {
  const std::string in = file(without_cap(sphere(4), 60), "in.off");
  const RunResult run = run_program({"fill", in, out("out.off"), "--max-new-vertices", "30"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("limit of new vertices"), std::string::npos);
  EXPECT_TRUE(topology(out("out.off")).boundary_loops.empty());
  EXPECT_LE(read_mesh(out("out.off")).mesh().X.rows(), read_mesh(in).mesh().X.rows() + 30);
  const RunResult strict =
      run_program({"fill", in, out("strict.off"), "--max-new-vertices", "30", "--strict"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(out("strict.off")));
  const RunResult steps = run_program({"fill", in, out("steps.off"), "--max-steps", "1"});
  EXPECT_EQ(steps.exit_code, 1);
  EXPECT_NE(steps.err.find("not converged"), std::string::npos);
}

TEST_F(FillProgram, FairsARegionAgain) {
  Mesh mesh = sphere(3);
  std::string list, text = "# a sphere with one half pushed in\n";
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    if (mesh.X(v, 2) > 0.8) {
      mesh.X(v, 2) = 0.8;
      list += std::to_string(v) + "\n";
    }
  }
  const std::string in = file(mesh, "in.off");
  write_bytes(out("list.txt"), list);
  const RunResult run =
      run_program({"fill", in, out("out.off"), "--region", out("list.txt"), "--json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(report(run)["fairing"]["converged"], true);
  const Points X = read_mesh(out("out.off")).mesh().X;
  EXPECT_LT((X.rowwise().norm().array() - 1).abs().maxCoeff(), 0.005);

  // The same region is given as an OBJ group, whose inner vertices move.
  std::string groups[2] = {"g rest\n", "g cap\n"};
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    bool inside = false;
    std::string line = "f";
    for (const Index v : corners) {
      inside = inside || mesh.X(v, 2) == 0.8;
      line += " " + std::to_string(v + 1);
    }
    groups[inside ? 1 : 0] += line + "\n";
  }
  for (const auto x : mesh.X.rowwise()) {
    text += "v " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) +
            "\n";
  }
  write_bytes(out("groups.obj"), text + groups[0] + groups[1]);
  const RunResult group =
      run_program({"fill", out("groups.obj"), out("faired.obj"), "--region", "cap"});
  EXPECT_EQ(group.exit_code, 0) << group.err;
  EXPECT_LT((read_mesh(out("faired.obj")).mesh().X.rowwise().norm().array() - 1).abs().maxCoeff(),
            0.005);
  EXPECT_EQ(run_program({"fill", in, out("y.off"), "--region", "nothing"}).exit_code, 2);
}

TEST_F(FillProgram, HostileLoopsNeverEndInSilence) {
  int open = 0;
  for (const auto& [name, mesh] : all_meshes()) {
    SCOPED_TRACE(name);
    const std::string in = file(mesh, "in" + std::to_string(open++) + ".off");
    const RunResult run = run_program({"fill", in, in + ".out.off", "--all", "--json"});
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 1) << run.err;
    const json filled = report(run);
    for (const json& hole : filled["holes"]) {
      EXPECT_TRUE(hole["new_triangles"] > 0 || !hole["reason"].get<std::string>().empty());
      EXPECT_TRUE(hole["status"] != "failed" || run.exit_code == 1);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
