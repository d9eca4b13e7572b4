// `ibmfair fill --bridge A,B` joins two holes by a tube.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/fill/holes.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// The mesh without the faces whose centre is chosen.
Mesh cut(const Mesh& mesh, const std::function<bool(const Vec3&)>& chosen) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    Vec3 centre = Vec3::Zero();
    for (const Index v : mesh.faces[f]) {
      centre += mesh.X.row(v) / static_cast<double>(mesh.faces[f].size());
    }
    if (chosen(centre)) {
      faces.push_back(f);
    }
  }
  return without_triangles(mesh, faces);
}

Mesh joined(const Mesh& a, const Mesh& b, bool reverse_b = false) {
  Mesh both = a;
  both.X.resize(a.X.rows() + b.X.rows(), 3);
  both.X << a.X, b.X;
  for (Index f = 0; f < b.faces.size(); ++f) {
    std::vector<Index> corners;
    for (const Index v : b.faces[f]) {
      corners.push_back(v + static_cast<Index>(a.X.rows()));
    }
    if (reverse_b) {
      std::ranges::reverse(corners);
    }
    both.faces.add(corners);
  }
  return both;
}

double angle_of(const Vec3& x) {
  return std::atan2(x[1], x[0]);
}

const double tube_radius = 1 / std::sqrt(2.0);  // of the Clifford torus, whose axis has radius 1

/// The Clifford torus without the part within `half_angle` of the direction (1, 0, 0).
Mesh torus_without_ring(double half_angle, Index columns = 80) {
  return cut(make_shape("torus", {.columns = columns}),
             [&](const Vec3& x) { return std::abs(angle_of(x)) < half_angle; });
}

/// The half of the torus with y > 0, less the part within `half_angle` of its ends.
Mesh half_torus(double half_angle, Index columns) {
  return cut(make_shape("torus", {.columns = columns}), [&](const Vec3& x) {
    return std::abs(angle_of(x) - std::numbers::pi / 2) > std::numbers::pi / 2 - half_angle;
  });
}

/// The largest distance from the torus, relative to the radius of its tube.
double torus_error(const Points& X) {
  return ((((X.leftCols(2).rowwise().norm().array() - 1).square() + X.col(2).array().square())
               .sqrt() -
           tube_radius) /
          tube_radius)
      .abs()
      .maxCoeff();
}

/// The largest distance from the catenoid across its axis, relative to the radius there.
double catenoid_error(const Points& X) {
  return (X.leftCols(2).rowwise().norm().array() / X.col(2).array().cosh() - 1).abs().maxCoeff();
}

class FillBridge : public testing::Test {
 protected:
  struct Filled {
    Mesh before, after;
    json told;
    int exit_code = 0;

    Points new_X() const { return after.X.bottomRows(after.X.rows() - before.X.rows()); }
    Topology topology() const { return State(after).topology; }
  };

  Filled fill(const Mesh& mesh, const std::vector<std::string>& options) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++),
                      out = directory_ / "out.off";
    write_mesh(mesh, in);
    std::vector<std::string> arguments{"fill", in, out, "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_LE(run.exit_code, 1) << run.err;
    return {mesh, read_mesh(out).mesh(), json::parse(run.out, nullptr, false), run.exit_code};
  }

  void expect_refusal(const std::string& in, const std::vector<std::string>& options,
                      const std::string& message) {
    std::vector<std::string> arguments{"fill", in, directory_ / "refused.off"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 2) << message;
    EXPECT_TRUE(contains(run.err, message)) << run.err;
    EXPECT_FALSE(std::filesystem::exists(directory_ / "refused.off"));
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

TEST_F(FillBridge, TheMissingRingOfATorusComesBack) {
  for (const double half_angle : {0.2, 0.7, 1.4}) {
    for (const double scale : {1.0, 1e-8}) {
      SCOPED_TRACE(fmt::format("{} radians, scale {}", half_angle, scale));
      const Mesh mesh = moved(torus_without_ring(half_angle), scale, Vec3::Zero(), 0);
      const Filled filled = fill(mesh, {"--bridge", "0,1"});
      EXPECT_EQ(filled.exit_code, 0);
      EXPECT_LT(torus_error(filled.new_X() / scale), 0.01);
      const Topology topology = filled.topology();
      EXPECT_EQ(topology.boundary_loops.size(), 0u);
      EXPECT_EQ(topology.turned_triangles, 0);
      EXPECT_EQ(topology.component_count, 1);
      EXPECT_EQ(topology.euler_characteristic(), 0);
    }
  }
}

/// Both ends lie in one plane and face alike: the tube has to leave the plane.
TEST_F(FillBridge, TheMissingHalfOfATorusComesBack) {
  const Filled filled = fill(torus_without_ring(std::numbers::pi / 2), {"--bridge", "0,1"});
  EXPECT_EQ(filled.exit_code, 0);
  EXPECT_LT(torus_error(filled.new_X()), 0.03);
  EXPECT_EQ(filled.topology().euler_characteristic(), 0);
}

TEST_F(FillBridge, TwoPiecesOfATorusBecomeOne) {
  for (const Index columns : {80, 50}) {
    for (const bool inside_out : {false, true}) {
      SCOPED_TRACE(fmt::format("{} columns, inside out: {}", columns, inside_out));
      Mesh other = half_torus(0.4, columns);
      other.X.leftCols(2) *= -1;
      const Mesh mesh = joined(half_torus(0.4, 80), other, inside_out);
      EXPECT_EQ(State(mesh).topology.component_count, 2);
      const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
      ASSERT_EQ(holes.size(), 4u);
      const auto side = [&](Index hole) { return mesh.X(holes[hole].loop[0], 0) > 0; };
      const Index partner = side(0) == side(2) ? 2 : 3;
      const Filled filled = fill(mesh, {"--bridge", fmt::format("0,{}", partner), "--bridge",
                                        fmt::format("1,{}", 5 - partner)});
      EXPECT_EQ(filled.exit_code, 0);
      EXPECT_LT(torus_error(filled.new_X()), 0.01);
      const Topology topology = filled.topology();
      EXPECT_EQ(topology.component_count, 1);
      EXPECT_EQ(topology.boundary_loops.size(), 0u);
      EXPECT_EQ(topology.euler_characteristic(), 0);
      EXPECT_TRUE(topology.orientable);
      EXPECT_TRUE(topology.defects.empty());
      EXPECT_EQ(topology.turned_triangles > 0, inside_out);
      const json& warnings = filled.told["warnings"];
      EXPECT_EQ(warnings.size(), inside_out ? 1u : 0u) << warnings;
    }
  }
}

TEST_F(FillBridge, TheMissingRingOfACatenoidComesBack) {
  const Mesh catenoid = make_shape("catenoid", {.columns = 64});
  for (const double half_width : {0.15, 0.4}) {
    const Mesh mesh =
        cut(catenoid, [&](const Vec3& x) { return std::abs(x[2] - 0.1) < half_width; });
    // 2: the patch is stationary; 0: it is a soap film, and the catenoid is one, too.
    for (const char* continuity : {"2", "0"}) {
      SCOPED_TRACE(fmt::format("half width {}, continuity {}", half_width, continuity));
      const Filled filled =
          fill(mesh, {"--bridge", "1,2", "--only", "1,2", "--continuity", continuity});
      EXPECT_EQ(filled.exit_code, 0);
      EXPECT_LT(catenoid_error(filled.new_X()), 0.01);
      EXPECT_EQ(filled.topology().component_count, 1);
      EXPECT_EQ(filled.topology().boundary_loops.size(), 2u);
    }
  }
}

TEST_F(FillBridge, ABridgeBetweenTwoPiecesIsOneSphereAndWithinOneAHandle) {
  const auto cap = [](const Vec3& axis) {
    return [axis](const Vec3& x) { return x.dot(axis) > 0.9; };
  };
  const Mesh left = cut(sphere(3), cap(Vec3(1, 0, 0)));
  const Mesh right = moved(cut(sphere(3), cap(Vec3(-1, 0, 0))), 1, Vec3(2.6, 0.3, 0), 0);
  const Filled dumbbell = fill(joined(left, right), {"--bridge", "0,1", "--continuity", "1"});
  EXPECT_EQ(dumbbell.exit_code, 0);
  EXPECT_EQ(dumbbell.topology().component_count, 1);
  EXPECT_EQ(dumbbell.topology().euler_characteristic(), 2);
  const Mesh both = cut(left, cap(Vec3(0, 0, 1)));
  const Filled handle = fill(both, {"--bridge", "1,0", "--continuity", "1"});
  EXPECT_EQ(handle.topology().boundary_loops.size(), 0u);
  EXPECT_EQ(handle.topology().euler_characteristic(), 0);
  EXPECT_EQ(handle.topology().turned_triangles, 0);
}

/// Whether one hole faces the other, and this one faces away.
bool face_alike(const Mesh& mesh, const Hole& a, const Hole& b) {
  const auto outlook = [&](const Hole& hole) {
    const Points X = mesh.X(hole.loop, Eigen::all);
    const Vec3 x = X.row(0), y = X.row(1), z = X.row(2);
    return std::pair<Vec3, Vec3>((x + y + z) / 3, (y - x).cross(z - x).normalized());
  };
  const auto [middle, normal] = outlook(a);
  const auto [other_middle, other_normal] = outlook(b);
  const Vec3 way = (other_middle - middle).normalized();
  return normal.dot(way) * other_normal.dot(way) > 0.2;
}

/// Also between the smallest holes, where the strip could go round one of them at a single corner.
TEST_F(FillBridge, TheResultIsASurface) {
  int bridges = 0;
  for (const Index columns : {6, 8}) {
    const Mesh torus = make_shape("torus", {.rows = 4, .columns = columns});
    for (Index f = 1; f < torus.faces.size(); ++f) {
      const auto shares_vertex = [&](Index v) {
        return std::ranges::find(torus.faces[f], v) != torus.faces[f].end();
      };
      if (std::ranges::any_of(torus.faces[0], shares_vertex)) {
        continue;
      }
      const Mesh mesh = without_triangles(torus, {0, f});
      const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
      if (face_alike(mesh, holes[0], holes[1])) {
        continue;  // refused
      }
      const Filled filled = fill(mesh, {"--bridge", "0,1"});
      const Topology topology = filled.topology();
      EXPECT_TRUE(topology.defects.non_manifold_edges.empty()) << columns << " " << f;
      if (filled.told["holes"][0]["status"] != "failed") {
        EXPECT_TRUE(topology.boundary_loops.empty()) << columns << " " << f;
        ++bridges;
      }
    }
  }
  EXPECT_GT(bridges, 10);
}

TEST_F(FillBridge, OtherHolesAreFilledAsUsual) {
  const Mesh mesh = cut(torus_without_ring(0.3), [](const Vec3& x) {
    return (x - Vec3(-1 - tube_radius, 0, 0)).norm() < 0.3;
  });
  const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
  ASSERT_EQ(holes.size(), 3u);
  std::vector<Index> ends;
  for (const Hole& hole : holes) {
    if (mesh.X(hole.loop[0], 0) > 0) {
      ends.push_back(hole.id);
    }
  }
  ASSERT_EQ(ends.size(), 2u);
  const std::string pair = fmt::format("{},{}", ends[0], ends[1]);
  const Filled all = fill(mesh, {"--bridge", pair});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_EQ(all.topology().boundary_loops.size(), 0u);
  EXPECT_LT(torus_error(all.new_X()), 0.01);
  const Filled bridge = fill(mesh, {"--bridge", pair, "--only", pair});
  EXPECT_EQ(bridge.topology().boundary_loops.size(), 1u);

  ASSERT_EQ(all.told["bridges"].size(), 1u);
  const json& told = all.told["bridges"][0];
  EXPECT_EQ(told["holes"], json(ends));
  EXPECT_EQ(told["status"], "filled");
  EXPECT_EQ(told["new_vertices"], bridge.new_X().rows());
  EXPECT_EQ(told["new_triangles"], bridge.after.faces.size() - mesh.faces.size());
  EXPECT_EQ(all.told["holes"][ends[0]]["bridged_to"], ends[1]);
  EXPECT_EQ(all.told["holes"][ends[1]]["bridged_to"], ends[0]);
  EXPECT_FALSE(all.told["holes"][3 - ends[0] - ends[1]].contains("bridged_to"));
}

TEST_F(FillBridge, TheNumberOfThreadsDoesNotMatter) {
  const Mesh mesh = torus_without_ring(0.5, 60);
  EXPECT_EQ(fill(mesh, {"--bridge", "0,1", "--threads", "1"}).after.X,
            fill(mesh, {"--bridge", "1,0", "--threads", "3"}).after.X);
}

/// A sheet rolled up twice, with two holes that lie behind each other.
Mesh roll() {
  Mesh sheet = flat_sheet(120, 12);
  for (auto x : sheet.X.rowwise()) {
    const double angle = 4 * std::numbers::pi * x[0], radius = 1 + 0.15 * angle;
    const double height = 6 * x[1];
    x << radius * std::cos(angle), radius * std::sin(angle), height;
  }
  return cut(sheet, [](const Vec3& x) {
    return std::abs(angle_of(x) - 1) < 0.3 && std::abs(x[2] - 3) < 1;
  });
}

TEST_F(FillBridge, OneSidedSurfacesAreRefused) {
  const Mesh mesh = roll();
  std::vector<Index> inner;
  for (const Hole& hole : find_holes(mesh.X, State(mesh).topology)) {
    if (hole.diameter < 3) {
      inner.push_back(hole.id);
    }
  }
  ASSERT_EQ(inner.size(), 2u);
  const std::string pair = fmt::format("{},{}", inner[0], inner[1]);
  write_mesh(mesh, directory_ / "roll.off");
  expect_refusal(directory_ / "roll.off", {"--bridge", pair}, "one-sided");

  // The same two holes, in pieces of their own: one piece counts as inside out.
  const Mesh pieces = cut(mesh, [](const Vec3& x) { return angle_of(x) < -2 || angle_of(x) > 2; });
  EXPECT_EQ(State(pieces).topology.component_count, 3);
  inner.clear();
  for (const Hole& hole : find_holes(pieces.X, State(pieces).topology)) {
    if (hole.diameter < 3) {
      inner.push_back(hole.id);
    }
  }
  ASSERT_EQ(inner.size(), 2u);
  const std::string ends = fmt::format("{},{}", inner[0], inner[1]);
  const Filled filled = fill(pieces, {"--bridge", ends, "--only", ends, "--continuity", "1"});
  EXPECT_EQ(filled.topology().component_count, 2);
  EXPECT_TRUE(filled.topology().orientable);
}

TEST_F(FillBridge, BadRequestsAreRefused) {
  const std::string in = directory_ / "in.off";
  write_mesh(torus_without_ring(0.3, 24), in);
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
      {{"0"}, "not a pair of ids"},
      {{"0,1,2"}, "not a pair of ids"},
      {{"0,x"}, "not a whole number"},
      {{"0,2"}, "no hole 2"},
      {{"1,1"}, "two different holes"},
      {{"0,1", "--bridge", "1,0"}, "an end of another bridge"},
      {{"0,1", "--only", "1"}, "hole 0 is left out: not among those asked for"},
      {{"0,1", "--max-edges", "4"}, "hole 0 is left out: it has"},
      {{"0,1", "--region", "@all"},
       "--bridge is about holes and cannot be combined with --region"}};
  for (const auto& [options, message] : bad) {
    std::vector<std::string> arguments{"--bridge"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refusal(in, arguments, message);
  }
  // Holes that touch: the two triangles have one vertex in common.
  for (const auto& [name, mesh] : holed_meshes()) {
    const std::vector<Hole> holes = find_holes(mesh.X, State(mesh).topology);
    if (name == "touching in a vertex") {
      write_mesh(mesh, directory_ / "touching.off");
      expect_refusal(directory_ / "touching.off", {"--bridge", "0,1"},
                     holes.size() == 2 ? "touch at vertex" : "no hole 1");
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
