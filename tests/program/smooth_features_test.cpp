// The options of `smooth` that keep features, through the real program.
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/smooth_runs.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class SmoothFeatures : public SmoothRuns {
 protected:
  /// A PLY sphere whose vertices carry a property `pace`: 0, 1 and 0.5 in turn.
  std::string paced() {
    Mesh mesh = make_shape("icosphere", {.subdivide = 3});
    mesh.X = shaken(State(mesh), 0.2);
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.X.rows()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n"
                       "property float pace\nelement face " +
                       std::to_string(mesh.faces.size()) +
                       "\nproperty list uchar int vertex_indices\nend_header\n";
    for (Index v = 0; v < mesh.X.rows(); ++v) {
      text += fmt::format("{} {} {} {}\n", mesh.X(v, 0), mesh.X(v, 1), mesh.X(v, 2), pace(v));
    }
    const Triangles F = triangulate(mesh).F;
    for (const auto& x : F.rowwise()) {
      text += fmt::format("3 {} {} {}\n", x[0], x[1], x[2]);
    }
    write_bytes(files_ / "paced.ply", text);
    return files_ / "paced.ply";
  }

  static double pace(Index v) { return v % 3 == 0 ? 0 : v % 3 == 1 ? 1 : 0.5; }
};

TEST_F(SmoothFeatures, KeepSharpKeepsTheEdgesOfACubeAndFlattensItsFaces) {
  const Points clean = make_shape("cube", {.subdivide = 4}).X;
  const std::string input = noisy("cube", {"--subdivide", "4", "--noise", "0.15"});
  const Smoothed rounded = smooth(input, {"--cutoff", "4"});
  const Smoothed sharp = smooth(input, {"--cutoff", "4", "--keep-sharp", "40"});
  EXPECT_LT(edge_error(sharp.X, clean), 0.5 * edge_error(rounded.X, clean));
  EXPECT_LT(edge_error(sharp.X, clean), edge_error(read_mesh(input).mesh().X, clean));
  EXPECT_LT(sharp.report["after"]["energy"], sharp.report["before"]["energy"]);
}

TEST_F(SmoothFeatures, WeightsComeFromAPropertyOrAFile) {
  const std::string input = paced();
  const Points before = read_mesh(input).mesh().X;
  std::string list = "# pace\n";
  for (Index v = 0; v < before.rows(); ++v) {
    list += std::to_string(pace(v)) + (v % 5 == 0 ? "\n" : ", ");
  }
  write_bytes(files_ / "pace.txt", list);
  const Smoothed by_property = smooth(input, {"--weights", "pace"});
  const Smoothed by_file = smooth(input, {"--weights", files_ / "pace.txt"});
  const Smoothed by_none = smooth(input, {});
  EXPECT_EQ(by_property.X, by_file.X);
  EXPECT_NE(by_property.X, by_none.X);
  for (Index v = 0; v < before.rows(); ++v) {
    EXPECT_EQ(by_property.X.row(v) == before.row(v), pace(v) == 0) << v;
  }
}

TEST_F(SmoothFeatures, WeightsThatCannotBeAreRefused) {
  const std::string input = paced();
  write_bytes(files_ / "short.txt", "1 1 1\n");
  write_bytes(files_ / "words.txt", "1 1\n1 many\n");
  write_bytes(files_ / "negative.txt", "1 -1\n");
  const std::vector<std::tuple<std::string, int, std::string>> cases{
      {"nothing", 2, "'nothing' is neither a vertex property of"},
      {"x", 3, "x of vertex"},
      {files_ / "short.txt", 3, "the file has 3 numbers, but the mesh has 642 vertices"},
      {files_ / "words.txt", 3, "words.txt:2: 'many' is not a finite number from 0 on"},
      {files_ / "negative.txt", 3, "negative.txt:1: '-1' is not"},
  };
  for (const auto& [source, code, message] : cases) {
    const Smoothed result = smooth(input, {"--weights", source});
    EXPECT_EQ(result.exit_code, code) << source;
    EXPECT_TRUE(contains(result.err, message)) << result.err;
    EXPECT_FALSE(std::filesystem::exists(files_ / "out.ply")) << source;
  }
}

TEST_F(SmoothFeatures, AndThoseThatAreNoNumbersInTheFile) {
  const std::string input = paced();
  const std::string good = read_bytes(input);
  for (const std::string value : {"nan", "inf", "-inf"}) {
    write_bytes(input, replaced(good, " 0.5\n", " " + value + "\n"));
    for (const std::string option : {"--weights", "--h0"}) {
      const Smoothed result = smooth(input, {"--laplacian", "lagrange", option, "pace"});
      EXPECT_EQ(result.exit_code, 3) << value << option;
      EXPECT_TRUE(contains(result.err, "pace of vertex 2 is " + value)) << result.err;
    }
    const Smoothed masked = smooth(input, {"--mask", "pace"});
    EXPECT_EQ(masked.exit_code, 0) << masked.err;
    EXPECT_EQ(masked.X.row(2), read_mesh(input).mesh().X.row(2)) << value;
  }
}

TEST_F(SmoothFeatures, SpontaneousCurvatureSetsTheRadius) {
  const std::string input = noisy("icosphere", {"--subdivide", "3"});
  const Words flow{"--laplacian", "lagrange", "--cutoff", "60", "--steps", "30"};
  std::string list;
  for (Eigen::Index v = 0; v < read_mesh(input).mesh().X.rows(); ++v) {
    list += "1.6\n";
  }
  write_bytes(files_ / "h0.txt", list);
  const Smoothed by_number = smooth(input, flow + Words{"--h0", "1.6"});
  const Smoothed by_file = smooth(input, flow + Words{"--h0", files_ / "h0.txt"});
  EXPECT_EQ(by_number.X, by_file.X);
  EXPECT_NEAR(by_number.X.rowwise().norm().mean(), 1.25, 0.01);
  EXPECT_LT(by_number.report["after"]["energy"],
            0.01 * by_number.report["before"]["energy"].get<double>());
  const Smoothed refused = smooth(input, {"--h0", "1.6"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "cannot be combined with --h0")) << refused.err;
}

TEST_F(SmoothFeatures, VolumeAndAreaStayToTheDigit) {
  const std::string input = noisy("torus", {"--rows", "24", "--columns", "60", "--noise", "0.2"});
  const Smoothed kept = smooth(input, {"--keep-volume", "--keep-area", "--cutoff", "12"});
  for (const char* figure : {"volume", "area"}) {
    const double before = kept.report["before"][figure], after = kept.report["after"][figure];
    EXPECT_NEAR(after / before, 1, 1e-12) << figure;
  }
  EXPECT_LT(kept.report["after"]["energy"], kept.report["before"]["energy"]);
  const std::string open = noisy("cylinder", {"--rows", "8", "--columns", "16"});
  const Smoothed refused = smooth(open, {"--keep-volume"});
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_TRUE(contains(refused.err, "need a closed mesh")) << refused.err;
  EXPECT_TRUE(contains(refused.err, "ibmfair fill")) << refused.err;
}

TEST_F(SmoothFeatures, TheUmbrellaIsNotRelaxedUnlessAsked) {
  const std::string input = noisy("icosphere", {"--subdivide", "3", "--noise", "0.2"});
  const auto tangential = [&](const Words& options) {
    return smooth(input, Words{"--laplacian", "umbrella"} + options)
        .report["options"]["tangential"];
  };
  EXPECT_EQ(tangential({}), "none");
  EXPECT_EQ(tangential({"--tangential", "relax"}), "relax");
  EXPECT_EQ(tangential({"--tangential", "keep"}), "keep");
}

TEST_F(SmoothFeatures, TwicingPutsBackHeight) {
  const std::string input = noisy("icosphere", {"--subdivide", "3", "--noise", "0.2"});
  const auto volume_lost = [](const Smoothed& result) {
    return std::abs(1 - result.report["after"]["volume"].get<double>() /
                            result.report["before"]["volume"].get<double>());
  };
  for (const char* laplacian : {"crouzeix-raviart", "lagrange", "umbrella"}) {
    const Words flow{"--laplacian", laplacian, "--cutoff", "16", "--steps", "4"};
    const Smoothed once = smooth(input, flow);
    const Smoothed twice = smooth(input, flow + Words{"--twicing", "1"});
    EXPECT_EQ(once.report["flow"]["twicings"], 0);
    EXPECT_EQ(twice.report["flow"]["twicings"], 1);
    EXPECT_LT(volume_lost(twice), 0.5 * volume_lost(once)) << laplacian;
  }
  EXPECT_EQ(smooth(input, {"--twicing", "-1"}).exit_code, 2);
}

TEST_F(SmoothFeatures, ABoundOnMovesIsHeldAndNoFailure) {
  const std::string input = noisy("torus", {"--rows", "24", "--columns", "60", "--noise", "0.3"});
  const Smoothed bounded = smooth(input, {"--max-move", "0.05e", "--cutoff", "12"});
  EXPECT_EQ(bounded.exit_code, 0) << bounded.err;
  const double bound = 0.05 * bounded.report["mesh"]["mean_edge_length"].get<double>();
  const double largest = (bounded.X - read_mesh(input).mesh().X).rowwise().norm().maxCoeff();
  EXPECT_LE(largest, bound * (1 + 1e-12));
  EXPECT_GT(largest, 0.99 * bound);
}

TEST_F(SmoothFeatures, MaterialDirectionsAreThoseOfTheSurfaceAndNotOfItsNoise) {
  const Words torus{"--rows", "32", "--columns", "80"};
  for (const char* direction : {"1,0,0,4", "0,0,1,4", "0,0,1,0.25"}) {
    const Words options{"--laplacian", "lagrange", "--anisotropy", direction};
    const json clean = smooth(noisy("torus", torus), options).report;
    const json rough = smooth(noisy("torus", torus + Words{"--noise", "0.2"}), options).report;
    const double energy = clean["after"]["energy"];
    EXPECT_NEAR(rough["after"]["energy"], energy, 0.2 * energy) << direction;
    const double angle = clean["after"]["smallest_angle_degrees"];
    EXPECT_GT(rough["after"]["smallest_angle_degrees"], 0.8 * angle) << direction;
    EXPECT_GT(rough["seconds"]["directions"], 0);
  }
}

TEST_F(SmoothFeatures, MaterialDirectionsAreRefusedBeforeAnythingIsDone) {
  const std::string torus = noisy("torus", {});
  for (const Words& options :
       {Words{"--anisotropy", "1,0,0,4"},
        {"--laplacian", "lagrange", "--anisotropy", "0,0,0,4"},
        {"--laplacian", "lagrange", "--anisotropy", "1,0,0,-4"},
        {"--laplacian", "lagrange", "--anisotropy", "1,0,0,4", "--h0", "1"}}) {
    for (const Words& dry : {Words{}, Words{"--dry-run"}}) {
      const Smoothed refused = smooth(torus, options + dry);
      EXPECT_EQ(refused.exit_code, 2) << refused.err;
      EXPECT_EQ(std::filesystem::exists(files_ / "out.ply"), false);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
