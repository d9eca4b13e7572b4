// No patch of `ibmfair fill` runs away from its hole, and what sticks out of a rim or lies inside a
// hole does not spoil the patch. The meshes in fill/reported are small copies of what users sent.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/fill/holes.h"
#include "ibmfair/io/mesh_file.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class FillBound : public testing::Test {
 protected:
  struct Filled {
    Mesh before, after;
    json holes;
    int exit_code = 0;

    Points new_X() const { return after.X.bottomRows(after.X.rows() - before.X.rows()); }

    /// The largest difference of the distance of a new vertex from the origin to `radius`, relative
    /// to the radius.
    double radial_error(double radius) const {
      return (new_X().rowwise().norm().array() / radius - 1).abs().maxCoeff();
    }
  };

  Filled fill(const std::string& path, std::vector<std::string> options = {}) {
    const std::string out = directory_ / "out.off";
    std::vector<std::string> arguments{"fill", path, out, "--json", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 1) << run.err;
    const json told = json::parse(run.out, nullptr, false);
    return {read_mesh(path).mesh(), read_mesh(out).mesh(), told["holes"], run.exit_code};
  }

  Filled fill(const Mesh& mesh, std::vector<std::string> options = {}) {
    const std::string path = directory_ / fmt::format("in{}.off", inputs_++);
    write_mesh(mesh, path);
    return fill(path, std::move(options));
  }

  static std::string reported(const std::string& name) {
    return project_file("tests/fill/reported/" + name);
  }

  static std::size_t open_loops(const Mesh& mesh) {
    return State(mesh).topology.boundary_loops.size();
  }

  /// Every hole is filled within the bounds that its surroundings suggest, or open with the reason.
  static void expect_no_balloon(const Filled& filled) {
    const std::vector<Hole> holes = find_holes(filled.before.X, State(filled.before).topology);
    double diameter = 0;
    for (const Hole& hole : holes) {
      diameter = std::max(diameter, hole.diameter);
    }
    const Eigen::AlignedBox3d body(Vec3(filled.before.X.colwise().minCoeff().transpose()),
                                   Vec3(filled.before.X.colwise().maxCoeff().transpose()));
    for (const auto row : filled.after.X.rowwise()) {
      ASSERT_LE(body.exteriorDistance(Vec3(row.transpose())), diameter);
    }
    for (const json& hole : filled.holes) {
      if (hole["status"] == "failed") {
        EXPECT_NE(hole["reason"], "");
        EXPECT_EQ(filled.exit_code, 1);
      } else if (hole["status"] != "skipped") {
        EXPECT_NE(hole["method"], "");
        EXPECT_LE(hole["diameter_ratio"], 3);
        EXPECT_LE(hole["area_ratio"], 4);
      }
    }
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

/// The right answer is many times as large as its hole: the rest of the sphere.
TEST_F(FillBound, TheRestOfASphereComesBack) {
  for (const int level : {3, 4}) {
    for (const double left : {72.0, 64.0, 50.0, 40.0, 30.0}) {
      SCOPED_TRACE(fmt::format("level {}, {} degrees", level, left));
      const Filled filled = fill(without_cap(sphere(level), 180 - left), {"--all"});
      ASSERT_EQ(filled.holes.size(), 1u);
      EXPECT_EQ(filled.holes[0]["status"], "filled");
      EXPECT_EQ(open_loops(filled.after), 0u);
      EXPECT_LT(filled.radial_error(1), level == 3 ? 0.02 : 0.01);
    }
  }
}

TEST_F(FillBound, TheRestOfACoarseSphereComesBack) {
  const Filled filled = fill(reported("dish3_30.off"), {"--all"});
  EXPECT_EQ(filled.exit_code, 0);
  EXPECT_EQ(open_loops(filled.after), 0u);
  EXPECT_LT(filled.radial_error(10), 0.01);
}

TEST_F(FillBound, NoPatchRunsAwayFromARoughRim) {
  for (const double degrees : {20.0, 45.0, 90.0}) {
    for (const double noise : {0.2, 0.5, 1.0}) {
      for (const unsigned seed : {1u, 2u}) {
        SCOPED_TRACE(fmt::format("{} degrees, noise {}, seed {}", degrees, noise, seed));
        Mesh mesh = without_cap(sphere(3), degrees);
        mesh.X = shaken(State(mesh), noise, seed);
        expect_no_balloon(fill(mesh));
        expect_no_balloon(fill(mesh, {"--rim-smooth", "2"}));
        const Filled generous = fill(mesh, {"--max-new-vertices", "1000000"});
        expect_no_balloon(generous);
        const double edges = generous.holes[0]["edges"];
        EXPECT_LE(generous.new_X().rows(), 64 + edges * edges);
      }
    }
  }
}

TEST_F(FillBound, NoPatchRunsAwayFromASpikeAtTheRim) {
  for (const double degrees : {20.0, 45.0, 90.0}) {
    for (const double height : {0.7, 1.3, 2.0}) {
      SCOPED_TRACE(fmt::format("{} degrees, height {}", degrees, height));
      Mesh mesh = without_cap(sphere(3), degrees);
      const std::vector<Index> rim = find_holes(mesh.X, State(mesh).topology)[0].loop;
      for (std::size_t i = 0; i < rim.size(); i += 5) {
        mesh.X.row(rim[i]) *= height;
      }
      expect_no_balloon(fill(mesh));
    }
  }
}

TEST_F(FillBound, SpikesAtTheRimGiveThePatchNoDirection) {
  const Filled filled = fill(reported("q_5_2.off"));
  EXPECT_EQ(filled.exit_code, 0);
  EXPECT_EQ(filled.holes[0]["protruding"].size(), 8u);
  EXPECT_LE(filled.after.X.col(2).maxCoeff(), 11.5);
  EXPECT_LT(filled.radial_error(10), 0.12);
}

/// A fin is a triangle at an edge of three triangles. Its vertices keep their places, and the hole
/// is filled as if the fin were not there.
TEST_F(FillBound, AFinAtTheRimIsLeftAside) {
  const Filled filled = fill(reported("fin_at_rim.off"));
  EXPECT_EQ(filled.exit_code, 0);
  ASSERT_EQ(filled.holes.size(), 1u);
  EXPECT_EQ(filled.holes[0]["protruding"], json({296}));
  EXPECT_EQ(filled.after.X.topRows(filled.before.X.rows()), filled.before.X);
  EXPECT_LT(filled.radial_error(10), 0.001);

  Mesh without_fin = filled.before;
  without_fin = without_triangles(without_fin, {296});
  EXPECT_EQ(fill(without_fin).new_X(), filled.new_X());
}

TEST_F(FillBound, AnIslandIsJoinedToTheMeshAroundIt) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{}, {"--all"}, {"--only", "0,1"}}) {
    const Filled filled = fill(reported("island.off"), options);
    EXPECT_EQ(filled.exit_code, 0);
    EXPECT_EQ(open_loops(filled.after), 0u);
    EXPECT_EQ(State(filled.after).topology.component_count, 1);
    EXPECT_LT(filled.radial_error(10), 0.01);
  }
  const Filled apart = fill(reported("island.off"), {"--only", "0"});
  EXPECT_EQ(apart.holes[1]["status"], "skipped");
  EXPECT_EQ(State(apart.after).topology.component_count, 2);
}

TEST_F(FillBound, ATJunctionIsNamedACrack) {
  const Filled filled = fill(reported("tjunction.off"));
  EXPECT_EQ(filled.exit_code, 1);
  ASSERT_EQ(filled.holes.size(), 1u);
  EXPECT_EQ(filled.holes[0]["crack"], true);
  EXPECT_NE(filled.holes[0]["reason"].get<std::string>().find("vertex 642 lies on the edge"),
            std::string::npos);
}

}  // namespace
}  // namespace ibmfair::test
