// `ibmfair fill --keep-sharp` continues sharp edges through a patch, and changes nothing where no
// sharp edge reaches a hole.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/creased_meshes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

class FillCreases : public testing::Test {
 protected:
  struct Filled {
    Mesh after;
    Points new_X;
    json hole;  ///< the report of the first hole that was filled
    std::string bytes;
    int exit_code = 0;
  };

  Filled fill(const Mesh& mesh, const Words& options) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++),
                      out = directory_ / "out.off";
    write_mesh(mesh, in);
    Words arguments{"fill", in, out, "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 1) << run.err;
    const json told = json::parse(run.out, nullptr, false);
    json hole;
    for (const json& some : told["holes"]) {
      hole = hole.is_null() && some["status"] != "skipped" ? some : hole;
    }
    Filled filled{read_mesh(out).mesh(), {}, hole, read_bytes(out), run.exit_code};
    filled.new_X = filled.after.X.bottomRows(filled.after.X.rows() - mesh.X.rows());
    return filled;
  }

  static void expect_good(const Filled& filled) {
    EXPECT_EQ(filled.exit_code, 0);
    EXPECT_EQ(filled.hole["status"], "filled");
    EXPECT_EQ(filled.hole["folded_hinges"], 0);
    EXPECT_EQ(filled.hole["intersections"], 0);
    EXPECT_EQ(State(filled.after).topology.boundary_loops.size(), 0u);
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

/// Where the cube of `support/creased_meshes.h` is after `moved`.
struct Placed {
  double scale;
  Vec3 offset;

  Mesh mesh(const Mesh& mesh) const { return moved(mesh, scale, offset); }

  /// Points in the frame in which the cube is [-1, 1]^3.
  Points back(const Points& X) const {
    Mesh frame;
    frame.X = Eigen::Matrix3d::Identity();
    const Points axes = moved(frame, 1, Vec3::Zero()).X;  // one a row
    return (X.rowwise() - offset.transpose()) * axes.transpose() / scale;
  }
};

const std::vector<Placed> places{{1, Vec3::Zero()},
                                 {1e-8, Vec3(1, 2, 3) * 1e-8},
                                 {1e8, Vec3(-3, 1, 0) * 1e8},
                                 {1, Vec3(1e4, -1e4, 1e4)}};

struct CubeHole {
  Vec3 place;
  int rings;
  int curves, corners;  ///< of the creases in the hole
};

/// Holes across edges, around a corner, around a corner but not in its middle, and holes whose rim
/// lies on an edge.
const std::vector<CubeHole> cube_holes{
    {{1, 1, 0}, 4, 1, 0},     {{1, 1, 1}, 4, 3, 1},      {{1, 0.75, 0.625}, 3, 1, 0},
    {{1, 0.76, 0}, 2, 0, 0},  {{1, 1, 0}, 1, 1, 0},      {{1, -1, 0.31}, 2, 1, 0},
    {{0.7, 1, 0.2}, 4, 1, 0}, {{1, 1, 1}, 1, 3, 1},      {{1, 1, 1}, 2, 3, 1},
    {{-1, 1, 0.7}, 4, 3, 1},  {{1, 0.76, 0.76}, 4, 3, 1}};

TEST_F(FillCreases, ACubeComesBack) {
  for (const Placed& placed : places) {
    const bool is_first = &placed == &places.front();
    for (std::size_t i = 0; i < (is_first ? cube_holes.size() : 3); ++i) {
      const auto& [place, rings, curves, corners] = cube_holes[i];
      SCOPED_TRACE(fmt::format("scale {}, offset {}, hole {}", placed.scale, placed.offset[0], i));
      const Filled filled =
          fill(placed.mesh(without_rings(cube(4), place, rings)), {"--keep-sharp", "30"});
      expect_good(filled);
      EXPECT_EQ(filled.hole["creases"]["curves"], curves);
      EXPECT_EQ(filled.hole["creases"]["corners"], corners);
      EXPECT_EQ(filled.hole["creases"]["left_out"], 0);
      EXPECT_EQ(filled.hole["creases"]["reason"], "");
      const Points X = placed.back(filled.new_X);
      const double tolerance = placed.offset.norm() > 10 * placed.scale ? 1e-9 : 1e-13;
      EXPECT_LT((X.cwiseAbs().rowwise().maxCoeff().array() - 1).abs().maxCoeff(), tolerance);
      const Points all = placed.back(filled.after.X);
      EXPECT_NEAR(enclosed_volume(all, State(filled.after).topology.F), 8, 100 * tolerance);
    }
  }
}

/// A hole in which a whole edge of the cube is missing, and one in which a whole face is missing.
TEST_F(FillCreases, EdgesAndFacesOfACubeComeBack) {
  const Mesh whole = cube(4);
  const Points N = triangle_normals(whole.X, State(whole).topology.F);
  std::vector<Index> at_edge, on_face;
  for (Index t = 0; t < whole.faces.size(); ++t) {
    const Vec3 x = whole.X(whole.faces[t], Eigen::all).colwise().mean();
    const double beyond = std::max(0.0, std::abs(x[2]) - 1);
    if (Vec3(x[0] - 1, x[1] - 1, beyond).norm() < 0.45) {
      at_edge.push_back(t);
    }
    if (N(t, 1) > 0.5) {
      on_face.push_back(t);
    }
  }
  for (const Placed& placed : places) {
    for (const std::vector<Index>& gone : {at_edge, on_face}) {
      const Filled filled =
          fill(placed.mesh(without_triangles(whole, gone)), {"--keep-sharp", "30"});
      expect_good(filled);
      const bool is_edge = gone == at_edge;
      EXPECT_EQ(filled.hole["creases"]["curves"], is_edge ? 5 : 0);
      EXPECT_EQ(filled.hole["creases"]["corners"], is_edge ? 2 : 0);
      const Points all = placed.back(filled.after.X);
      EXPECT_NEAR(enclosed_volume(all, State(filled.after).topology.F), 8, 1e-7);
    }
  }
}

/// The test above can fail: without the option the edges are round.
TEST_F(FillCreases, WithoutTheOptionEdgesAreRound) {
  for (const Vec3& place : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const Filled filled = fill(without_rings(cube(4), place, 4), {});
    EXPECT_FALSE(filled.hole.contains("creases"));
    EXPECT_LT(enclosed_volume(filled.after.X, State(filled.after).topology.F), 8 - 1e-4);
  }
}

/// The distance of a point from the surface of closed_cylinder.
double distance_to_cylinder(const Vec3& x) {
  const double r = std::hypot(x[0], x[1]);
  const double wall = std::hypot(r - 1, std::max(0.0, x[2] - 1));
  const double lid = std::hypot(x[2] - 1, std::max(0.0, r - 1));
  return std::min(wall, lid);
}

TEST_F(FillCreases, TheEndOfACylinderComesBack) {
  for (const int rings : {2, 4, 6}) {
    SCOPED_TRACE(rings);
    const Mesh mesh = without_rings(closed_cylinder(64), Vec3(1, 0, 1), rings);
    const auto largest = [&](const Filled& filled) {
      double result = 0;
      for (const auto x : filled.new_X.rowwise()) {
        result = std::max(result, distance_to_cylinder(x.transpose()));
      }
      return result;
    };
    const Filled filled = fill(mesh, {"--keep-sharp", "30"});
    expect_good(filled);
    EXPECT_EQ(filled.hole["creases"]["curves"], 1);
    const double diameter = filled.hole["diameter"];
    EXPECT_LT(largest(filled), 1.5e-3 * diameter);
    EXPECT_GT(largest(fill(mesh, {})), 20 * largest(filled));
    int on_circle = 0;
    for (const auto x : filled.new_X.rowwise()) {
      on_circle += std::hypot(std::hypot(x[0], x[1]) - 1, x[2] - 1) < 1e-12 ? 1 : 0;
    }
    EXPECT_EQ(on_circle, 2 * rings - 1);
  }
}

TEST_F(FillCreases, NothingChangesIfNoCreaseReachesTheHole) {
  const std::vector<Mesh> meshes{without_cap(sphere(4), 30),
                                 without_rings(cube(5), Vec3(1, 0, 0), 4),
                                 without_rings(closed_cone(64), Vec3(0, 0, 1), 4),
                                 without_rings(closed_cylinder(64), Vec3(1, 0, 0.5), 3),
                                 flat_sheet(12, 12),
                                 make_shape("cylinder", {.rows = 12, .columns = 40})};
  for (const Mesh& mesh : meshes) {
    const Filled before = fill(mesh, {"--all"});
    for (const std::string angle : {"30", "60", "auto"}) {
      const Filled after = fill(mesh, {"--all", "--keep-sharp", angle});
      EXPECT_EQ(after.bytes, before.bytes);
      EXPECT_EQ(after.hole, before.hole);
    }
  }
}

TEST_F(FillCreases, AutoTakesTheAngleFromTheMesh) {
  for (const Vec3& place : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const Mesh mesh = without_rings(cube(5), place, 4);
    const Filled chosen = fill(mesh, {"--keep-sharp", "auto"});
    expect_good(chosen);
    EXPECT_EQ(chosen.bytes, fill(mesh, {"--keep-sharp", "30"}).bytes);
  }
  // The edges of a rough sphere are as sharp, but form no lines.
  Mesh rough = without_cap(sphere(4), 30);
  add_noise(rough.X, 0.02, 3);
  EXPECT_TRUE(fill(rough, {"--keep-sharp", "20"}).hole.contains("creases"));
  EXPECT_EQ(fill(rough, {"--keep-sharp", "auto"}).bytes, fill(rough, {}).bytes);
}

/// A roof whose ridge becomes flat within the hole: a crease that ends nowhere.
TEST_F(FillCreases, ASingleCreaseIsNotContinued) {
  Mesh roof = flat_sheet(24, 24);
  for (auto x : roof.X.rowwise()) {
    x[2] = -3 * std::pow(std::max(0.0, 1 - 2 * x[0]), 2) * std::abs(x[1] - 0.5);
  }
  const Mesh mesh = without_rings(roof, Vec3(0.5, 0.5, 0), 5);
  const Filled filled = fill(mesh, {"--keep-sharp", "30"});
  EXPECT_EQ(filled.exit_code, 0);
  EXPECT_EQ(filled.hole["creases"]["ends"], 1);
  EXPECT_EQ(filled.hole["creases"]["left_out"], 1);
  EXPECT_EQ(filled.hole["creases"]["curves"], 0);
  EXPECT_EQ(filled.hole["creases"]["reason"], "a single crease ends at its rim");
  EXPECT_EQ(filled.bytes, fill(mesh, {}).bytes);
}

TEST_F(FillCreases, HolesThatTouchAreFilledWithoutCreases) {
  const Mesh once = without_rings(cube(4), Vec3(1, 1, 0), 1);
  const Mesh twice = without_rings(once, Vec3(1, 1, 0.25), 1);
  ASSERT_FALSE(State(twice).topology.boundary_loops.empty());
  const Filled filled = fill(twice, {"--keep-sharp", "30"});
  expect_good(filled);
  EXPECT_EQ(filled.hole["creases"]["reason"], "the patch has several loops");
  EXPECT_EQ(filled.bytes, fill(twice, {}).bytes);
}

TEST_F(FillCreases, TheCreaseIsContinuedAtEveryPatchMethod) {
  const Mesh mesh = without_rings(closed_cylinder(64), Vec3(1, 0, 1), 4);
  for (const Words& options :
       {Words{"--laplacian", "lagrange"}, Words{"--laplacian", "crouzeix-raviart"},
        Words{"--no-fair"}, Words{"--no-mass"}}) {
    Words all{"--keep-sharp", "30"};
    all.insert(all.end(), options.begin(), options.end());
    const Filled filled = fill(mesh, all);
    expect_good(filled);
    EXPECT_EQ(filled.hole["creases"]["curves"], 1);
    for (const auto x : filled.new_X.rowwise()) {
      EXPECT_LT(distance_to_cylinder(x.transpose()), 0.03);
    }
  }
}

TEST_F(FillCreases, TheLimitOfNewVerticesHolds) {
  const Mesh mesh = without_rings(cube(5), Vec3(1, 1, 0), 7);
  for (const int limit : {1, 13, 40}) {
    const Filled filled =
        fill(mesh, {"--keep-sharp", "30", "--max-new-vertices", std::to_string(limit)});
    EXPECT_EQ(filled.exit_code, 1);
    EXPECT_EQ(filled.hole["status"], "coarse");
    EXPECT_LE(filled.new_X.rows(), limit);
    EXPECT_EQ(filled.hole["creases"]["curves"], limit < 13 ? 0 : 1);
  }
}

TEST_F(FillCreases, TheEdgeLengthHoldsBetweenCreases) {
  const Mesh mesh = without_rings(cube(5), Vec3(1, 1, 0), 7);
  const auto vertices = [&](const Words& length) {
    const Filled filled = fill(mesh, Words{"--keep-sharp", "30"} + length);
    EXPECT_EQ(filled.hole["creases"]["curves"], 1);
    return filled.new_X.rows();
  };
  EXPECT_GT(vertices({"--edge-length", "0.5e"}), 2 * vertices({}));
}

TEST_F(FillCreases, OptionsThatDoNotGoTogetherAreRefused) {
  write_mesh(without_rings(cube(3), Vec3(1, 1, 0), 1), directory_ / "in.off");
  for (const Words& options :
       {Words{"--keep-sharp", "0"}, Words{"--keep-sharp", "blunt"}, Words{"--keep-sharp", ""},
        Words{"--keep-sharp", "180"}, Words{"--keep-sharp", "30", "--no-refine"},
        Words{"--keep-sharp", "30", "--region", "@all"}, Words{"--no-fair", "--region", "@all"},
        Words{"--only", "0", "--region", "@all"}, Words{"--rim-smooth", "1", "--region", "@all"},
        Words{"--keep-sharp", "auto", "--rim-smooth", "2"}}) {
    Words arguments{"fill", directory_ / "in.off", directory_ / "out.off"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_program(arguments).exit_code, 2);
  }
}

}  // namespace
}  // namespace ibmfair::test
