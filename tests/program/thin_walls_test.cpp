// Thin walls and lines at which sheets meet, through the real program. The meshes in flow/reported
// are small copies of what users sent.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/flow/passes/meeting_lines.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/solids.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

struct ThinRun {
  std::string err;
  nlohmann::json report;
  Points X;

  double volume_ratio() const {
    return report["after"]["volume"].get<double>() / report["before"]["volume"].get<double>();
  }
};

class ThinWallRuns : public testing::Test {
 protected:
  ThinRun smooth(const std::string& input, const Words& options = {}) {
    const RunResult run =
        run_program(Words{"smooth", input, files_ / "out.off", "--overwrite", "--json"} + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return {run.err, nlohmann::json::parse(run.out, nullptr, false),
            read_mesh(files_ / "out.off").mesh().X};
  }

  ThinRun smooth(const State& state, const Words& options = {}) {
    write_mesh(mesh_from_triangles(state.X, state.topology.F), files_ / "in.off",
               {.overwrite = true});
    return smooth(files_ / "in.off", options);
  }

  static std::string reported(const std::string& name) {
    return project_file("tests/flow/reported/" + name);
  }

  /// The volume stays to a tenth, and no hinge folds over.
  void expect_kept(const State& state, double most) {
    const ThinRun result = smooth(state);
    EXPECT_NEAR(result.volume_ratio(), 1, most) << result.err;
    EXPECT_TRUE(FoldWatch(state.X, state.topology).new_folds(result.X).empty());
    EXPECT_LE(result.report["after"]["energy"].get<double>(),
              result.report["before"]["energy"].get<double>() * (1 + 1e-12));
    EXPECT_FALSE(result.report["warnings"].dump().find("changed their thickness") !=
                 std::string::npos);
  }

  TemporaryDirectory files_;
};

TEST_F(ThinWallRuns, PlateOfAUserKeepsItsVolume) {
  const ThinRun result = smooth(reported("plate14.off"));
  EXPECT_NEAR(result.volume_ratio(), 1, 0.01);  // it was 23.8
  EXPECT_EQ(result.report["after"]["folded_hinges"], 0);
  EXPECT_NE(result.err.find("stay fixed"), std::string::npos) << result.err;
}

TEST_F(ThinWallRuns, PlatesOfAnyThicknessKeepTheirVolume) {
  for (const double thickness : {0.01, 0.03, 0.1, 0.3, 0.5, 0.7, 1.0, 1.5}) {
    for (const double noise : {0.0, 0.1}) {
      SCOPED_TRACE(fmt::format("{} {}", thickness, noise));
      State state(plate(14, 14, thickness));
      if (thickness >= 3 * noise) {  // with more noise the sheets pass through each other
        state.X = shaken(state, noise);
        expect_kept(state, 0.1);
      }
    }
  }
}

TEST_F(ThinWallRuns, OtherThinPartsKeepTheirVolume) {
  for (const double thickness : {0.3, 0.5, 1.0}) {
    for (const double noise : {0.0, 0.1}) {
      const std::vector<std::pair<const char*, Mesh>> parts{
          {"tray", tray(12, 5, thickness)},      {"angle", angle_profile(12, 16, thickness)},
          {"washer", washer(10, 16, thickness)}, {"shell", half_shell(10, thickness)},
          {"leaf", leaf(24, 16, thickness)},     {"strip", plate(30, 3, thickness)},
          {"rod", plate(30, 1, thickness)}};
      for (const auto& [name, mesh] : parts) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, thickness, noise));
        State state(mesh);
        state.X = shaken(state, noise);
        expect_kept(state, 0.1);
      }
    }
  }
}

TEST_F(ThinWallRuns, SheetsOfThinWallsLoseTheirNoise) {
  const State flat(plate(24, 24, 0.5));
  State noisy = flat;
  noisy.X = shaken(flat, 0.1);
  const Points X = smooth(noisy).X;
  double before = 0, after = 0;
  for (Index v = 0; v < X.rows(); ++v) {
    const auto x = flat.X.row(v);
    if (std::min({x[0], x[1], 24 - x[0], 24 - x[1]}) > 4) {
      before += std::pow(noisy.X(v, 2) - x[2], 2);
      after += std::pow(X(v, 2) - x[2], 2);
    }
  }
  EXPECT_LT(after, 0.2 * before);
}

TEST_F(ThinWallRuns, AShortCutoffMovesTheRims) {
  const State state(plate(14, 14, 1));
  const ThinRun fixed = smooth(state, {"--cutoff", "8"});
  EXPECT_LT(fixed.report["mesh"]["unknowns"], state.X.rows());
  const ThinRun moves = smooth(state, {"--cutoff", "0.8"});
  EXPECT_EQ(moves.report["mesh"]["unknowns"], state.X.rows());
}

TEST_F(ThinWallRuns, ThickBodiesWithThinEarsFlowAsBefore) {
  const ThinRun result = smooth(project_file("data/bunny.obj"));
  EXPECT_EQ(result.report["mesh"]["unknowns"], result.report["mesh"]["vertices"]);
}

TEST_F(ThinWallRuns, CrumpledBodiesHaveNoWalls) {
  for (const double noise : {0.5, 0.7, 1.0}) {
    for (const int level : {2, 3}) {
      State state(make_shape("icosphere", {.subdivide = level}));
      add_noise(state.X, noise * mean_edge_length(state.X, state.topology.E), 1);
      const ThinRun result = smooth(state);
      EXPECT_EQ(result.report["mesh"]["unknowns"], state.X.rows()) << noise;
      EXPECT_EQ(result.err.find("thickness ("), std::string::npos) << result.err;
    }
  }
}

TEST_F(ThinWallRuns, WallsThatChangeAreMentioned) {
  State state(plate(14, 14, 1));
  const ThinRun result = smooth(state, {"--time-step", "1", "--keep-volume"});
  EXPECT_NE(result.err.find("changed their thickness"), std::string::npos) << result.err;
  EXPECT_NE(result.report["warnings"].dump().find("changed their thickness"), std::string::npos);
  EXPECT_EQ(result.err.find("--keep-volume"), std::string::npos) << result.err;  // was given
}

/// The distances of the vertices of the lines from a circle about the origin in the plane through
/// them: root mean squares along the radius and across the plane.
std::array<double, 2> errors_of_circle(const Points& X, const std::vector<MeetingLine>& lines) {
  std::vector<Index> vertices;
  for (const MeetingLine& line : lines) {
    vertices.insert(vertices.end(), line.vertices.begin(), line.vertices.end());
  }
  const Points P = X(vertices, Eigen::all);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(P.transpose() * P);
  const Vec3 normal = axes.eigenvectors().col(0);
  const Eigen::VectorXd height = P * normal;
  const Eigen::VectorXd along = (P - height * normal.transpose()).rowwise().norm();
  return {std::sqrt((along.array() - along.mean()).square().mean()),
          std::sqrt(height.array().square().mean())};
}

TEST_F(ThinWallRuns, LineOfALabelMapBecomesACircle) {
  const State state(read_mesh(reported("labels.off")).mesh());
  const auto lines = find_meeting_lines(state.topology);
  ASSERT_EQ(lines.size(), 1);
  const auto before = errors_of_circle(state.X, lines);
  for (const Words& options : {Words{}, Words{"--denoise"}}) {
    const ThinRun result = smooth(reported("labels.off"), options);
    const auto after = errors_of_circle(result.X, lines);
    EXPECT_LT(after[0], 0.5 * before[0]);
    EXPECT_LT(after[1], 0.5 * before[1]);
    EXPECT_EQ(result.report["after"]["folded_hinges"], 0);
    EXPECT_NE(result.err.find("1 line in which three or more sheets meet"), std::string::npos);
  }
}

TEST_F(ThinWallRuns, LinesOfLabelMapsLoseTheirSteps) {
  for (const Index radius : {6, 8, 9, 12}) {
    SCOPED_TRACE(radius);
    const State state(two_half_balls(radius));
    const auto lines = find_meeting_lines(state.topology);
    const auto before = errors_of_circle(state.X, lines),
               after = errors_of_circle(smooth(state).X, lines);
    // Where voxels touch at an edge only, the line has branches, which stay.
    const double left = lines.size() == 1 ? 0.6 : 0.9;
    EXPECT_LT(after[0], left * before[0]);
    EXPECT_LT(after[1], left * before[1]);
  }
}

TEST_F(ThinWallRuns, LinesObeyTheOptions) {
  const State state(two_half_balls(8));
  const auto lines = find_meeting_lines(state.topology);
  const auto longest_move = [&](const Words& options) {
    const Points moves = smooth(state, options).X - state.X;
    return moves(lines[0].vertices, Eigen::all).rowwise().norm().maxCoeff();
  };
  EXPECT_GT(longest_move({}), 0.5);
  EXPECT_LE(longest_move({"--max-move", "0.2u"}), 0.2 * (1 + 1e-12));
  EXPECT_EQ(longest_move({"--plain", "--cutoff", "2"}), 0);
  EXPECT_EQ(longest_move({"--steps", "0"}), 0);
  std::string all;
  for (Index v = 0; v < state.X.rows(); ++v) {
    all += fmt::format("{}\n", v);
  }
  write_bytes(files_ / "all.txt", all);
  EXPECT_EQ(longest_move({"--fix", files_ / "all.txt"}), 0);
  EXPECT_LT(longest_move({"--cutoff", "0.01"}), 1e-6);
}

// Moves vanish with the cut-off on coarse parts with sharp edges.
TEST_F(ThinWallRuns, ShortCutoffsLeaveCoarsePartsAsTheyAre) {
  const std::string pocket = reported("pk_7.off");
  const double edge = smooth(pocket, {"--steps", "0"}).report["mesh"]["mean_edge_length"];
  for (const double cutoff : {0.01, 0.1, 1.0}) {
    const ThinRun result = smooth(pocket, {"--cutoff", fmt::format("{}", cutoff)});
    EXPECT_LE(result.report["largest_move"].get<double>(), 0.2 * cutoff * cutoff * edge) << cutoff;
  }
  EXPECT_LE(smooth(pocket, {"--cutoff", "0.01%"}).report["largest_move"].get<double>(), 0.01);
}

TEST_F(ThinWallRuns, DoubleFacesNameTheRemedy) {
  const State sheet(read_mesh(reported("pk_7.off")).mesh());
  Mesh twice = mesh_from_triangles(sheet.X, sheet.topology.F);
  for (Index t = 0; t < sheet.topology.F.rows(); ++t) {
    const auto corners = sheet.topology.F.row(t);
    twice.faces.add(std::array<Index, 3>{corners[0], corners[1], corners[2]});
  }
  write_mesh(twice, files_ / "twice.off");
  const ThinRun result = smooth(files_ / "twice.off");
  EXPECT_EQ(result.X, sheet.X);
  EXPECT_NE(result.err.find("delete one triangle of each pair"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ibmfair::test
