// `ibmfair fill --continuity 0|1|2`: what patches continue at their rims.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/fill/holes.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class FillContinuity : public testing::Test {
 protected:
  struct Filled {
    Mesh before, after;
    json holes;

    Points new_X() const { return after.X.bottomRows(after.X.rows() - before.X.rows()); }
    double new_area() const {
      return surface_area(after.X, triangulate(after).F) -
             surface_area(before.X, triangulate(before).F);
    }
  };

  Filled fill(const Mesh& mesh, const std::vector<std::string>& options, int exit_code = 0) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++),
                      out = directory_ / "out.off";
    write_mesh(mesh, in);
    std::vector<std::string> arguments{"fill", in, out, "--all", "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    const json told = json::parse(run.out);
    const Mesh after = read_mesh(out).mesh();
    EXPECT_TRUE(State(after).topology.boundary_loops.empty());
    return {mesh, after, told["holes"]};
  }

  static void expect_method(const Filled& filled, const std::string& method) {
    for (const json& hole : filled.holes) {
      EXPECT_EQ(hole["status"], "filled");
      EXPECT_EQ(hole["method"], method);
      EXPECT_FALSE(hole.contains("surroundings"));
    }
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

Mesh cylinder(Index columns) {
  return make_shape("cylinder", {.columns = columns});
}

/// A cylinder with oblique ends.
Mesh oblique_cylinder() {
  Mesh mesh = cylinder(48);
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    mesh.X(v, 2) += 0.4 * mesh.X(v, 0);
  }
  return mesh;
}

/// A cube with a hole of ragged rim inside one side.
Mesh cube_with_hole() {
  const Mesh cube = make_shape("cube", {.subdivide = 4});
  std::vector<Index> cut;
  for (Index f = 0; f < cube.faces.size(); ++f) {
    if ((cube.X.row(cube.faces[f][0]).transpose() - Vec3(1, 0.1, 0)).norm() < 0.6) {
      cut.push_back(f);
    }
  }
  return without_triangles(cube, cut);
}

TEST_F(FillContinuity, PositionsAloneGiveAFlatLidOnAFlatRim) {
  for (const Placement placement : all_placements) {
    const std::vector<NamedMesh> meshes{
        {"cylinder", cylinder(40)}, {"oblique", oblique_cylinder()}, {"cube", cube_with_hole()}};
    for (const auto& [name, mesh] : placed(meshes, placement)) {
      SCOPED_TRACE(name);
      const Filled filled = fill(mesh, {"--continuity", "0"});
      expect_method(filled, "least area");
      for (const json& hole : filled.holes) {
        EXPECT_NEAR(hole["area_ratio"].get<double>(), 1, 1e-9);
      }
      // Every new vertex lies in the plane of the nearest rim.
      const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
      const Points X = filled.new_X();
      double farthest = 0;
      for (const auto x : X.rowwise()) {
        double distance = std::numeric_limits<double>::infinity();
        for (const Hole& hole : holes) {
          const Vec3 a = mesh.X.row(hole.loop[0]), b = mesh.X.row(hole.loop[hole.loop.size() / 3]),
                     c = mesh.X.row(hole.loop[hole.loop.size() * 2 / 3]);
          distance = std::min(distance,
                              std::abs((b - a).cross(c - a).normalized().dot(x.transpose() - a)));
        }
        farthest = std::max(farthest, distance);
      }
      const double size = bounding_box_size(mesh.X).norm();
      const double rounding = 1e-15 * mesh.X.cwiseAbs().maxCoeff();
      EXPECT_LE(farthest, 1e-12 * size + rounding);
    }
  }
}

TEST_F(FillContinuity, PositionsAloneGiveTheLeastArea) {
  const Mesh mesh = without_cap(sphere(4), 50);
  const double least = fill(mesh, {"--continuity", "0"}).new_area();
  EXPECT_LT(least, fill(mesh, {"--no-fair"}).new_area() * (1 + 1e-9));
  EXPECT_LT(least, fill(mesh, {"--continuity", "1"}).new_area());
  const double disc = std::numbers::pi * std::pow(std::sin(50 * std::numbers::pi / 180), 2);
  EXPECT_NEAR(least / disc, 1, 0.08);  // the ragged rim is inside the circle
}

TEST_F(FillContinuity, TangentsAloneGiveNoCrease) {
  double before = 90;
  for (const Index columns : {32, 64, 128}) {
    const Filled filled = fill(cylinder(columns), {"--continuity", "1"});
    expect_method(filled, "repeated linear fairing");
    for (const json& hole : filled.holes) {
      const double seam = hole["seam_degrees"]["median"];
      EXPECT_LT(seam, 16 * 32.0 / columns);  // of the order of the edge length
      EXPECT_LT(seam, before);
    }
    before = filled.holes[0]["seam_degrees"]["median"];
    EXPECT_GT(filled.new_X().col(2).maxCoeff(), 1.2 * filled.before.X.col(2).maxCoeff());
  }
}

/// Curvature is continued by 2 alone: a cap of a sphere comes back.
TEST_F(FillContinuity, CurvatureIsTheDefault) {
  const Mesh mesh = without_cap(sphere(4), 60);
  const Filled given = fill(mesh, {"--continuity", "2"}), left = fill(mesh, {});
  EXPECT_EQ(given.after.X, left.after.X);
  const auto error = [&](const char* continuity) {
    const Points X = fill(mesh, {"--continuity", continuity}).new_X();
    return (X.rowwise().norm().array() - 1).abs().maxCoeff();
  };
  EXPECT_LT(error("2"), 1e-3);
  EXPECT_GT(error("1"), 1e-2);
  EXPECT_GT(error("0"), error("1"));
}

TEST_F(FillContinuity, TheLimitsOfOtherPatchesHold) {
  const Filled filled =
      fill(without_cap(sphere(4), 60), {"--continuity", "0", "--max-new-vertices", "20"}, 1);
  EXPECT_EQ(filled.holes[0]["status"], "coarse");
  EXPECT_LE(filled.new_X().rows(), 20);
  const Filled coarse = fill(without_cap(sphere(4), 60), {"--continuity", "1", "--no-refine"});
  EXPECT_EQ(coarse.new_X().rows(), 0);
}

/// A job with all defaults written out is no contradiction.
TEST_F(FillContinuity, ADumpedJobRuns) {
  write_mesh(without_cap(sphere(2), 60), directory_ / "in.off");
  const RunResult job = run_program({"fill", directory_ / "in.off", directory_ / "out.off",
                                     "--continuity", "0", "--edge-length", "2e", "--dump-config"});
  ASSERT_EQ(job.exit_code, 0) << job.err;
  write_bytes(directory_ / "jobs.json", job.out);
  const RunResult run = run_program({"batch", directory_ / "jobs.json"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(FillContinuity, OptionsWithoutEffectAreRefused) {
  write_mesh(without_cap(sphere(2), 60), directory_ / "in.off");
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
      {{"3"}, "'3' is not known; write one of 0, 1, 2"},
      {{"0.5"}, "is not known"},
      {{"1", "--laplacian", "lagrange"}, "--laplacian cannot be combined with --continuity 1"},
      {{"0", "--no-mass"}, "--no-mass cannot be combined with --continuity 0"},
      {{"0", "--rim-smooth", "2"}, "--rim-smooth cannot be combined with --continuity 0"},
      {{"0", "--no-fair"}, "--no-fair cannot be combined with --continuity"},
      {{"0", "--region", "@all"}, "--region cannot be combined with --continuity"}};
  for (const auto& [options, message] : bad) {
    std::vector<std::string> arguments{"fill", directory_ / "in.off", directory_ / "out.off",
                                       "--continuity"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(contains(run.err, message)) << run.err;
  }
}

}  // namespace
}  // namespace ibmfair::test
