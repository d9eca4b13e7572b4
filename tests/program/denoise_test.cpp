// --denoise and --cutoff auto, through the real program.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/shapes.h"
#include "support/correlated_noise.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/smooth_runs.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class Denoise : public SmoothRuns {
 protected:
  /// The mean angle (degrees) between the face normals of the last result and those of `truth`.
  double degrees_off(const std::string& truth) const {
    const Words compare{"compare", files_ / "out.ply", truth, "--json"};
    return json::parse(run_program(compare).out)["face_normal_degrees"]["mean"].get<double>();
  }
};

TEST_F(Denoise, CutoffAutoIsTheCutoffThatItNames) {
  const std::string input = noisy("torus", {"--rows", "24", "--columns", "60", "--noise", "0.2"});
  const Smoothed chosen = smooth(input, {"--cutoff", "auto"});
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  const json& choice = chosen.report["cutoff_choice"];
  const double edge = chosen.report["mesh"]["mean_edge_length"];
  EXPECT_NEAR(choice["noise"].get<double>(), 0.2 * edge, 0.04 * edge);
  EXPECT_GE(choice["trials"].size(), 3);
  EXPECT_LT(choice["distance_expected"].get<double>(), 0.2 * edge);
  EXPECT_GT(choice["distance_expected_error"].get<double>(), 0);
  EXPECT_TRUE(contains(chosen.err, "error left")) << chosen.err;
  const std::string cutoff = fmt::format("{}u", choice["cutoff"].get<double>());
  const Smoothed named = smooth(input, {"--cutoff", cutoff, "--steps", "16"});
  EXPECT_EQ(named.X, chosen.X);
  EXPECT_FALSE(named.report.contains("cutoff_choice"));
  EXPECT_EQ(smooth(input, {"--cutoff", "auto", "--dry-run"}).report["cutoff_choice"], choice);
  EXPECT_TRUE(contains(smooth(input, {"--cutoff", "auto", "--verbose"}).err, "distance left"));
}

TEST_F(Denoise, CutoffAutoWhereThereIsNothingToChoose) {
  const std::string input = noisy("icosahedron", {"--noise", "0.1"});
  write_bytes(files_ / "all.txt", "0 1 2 3 4 5 6 7 8 9 10 11\n");
  const Smoothed fixed = smooth(input, {"--cutoff", "auto", "--fix", files_ / "all.txt"});
  EXPECT_EQ(fixed.exit_code, 0);
  EXPECT_TRUE(contains(fixed.err, "no vertex is free to move")) << fixed.err;
  EXPECT_FALSE(fixed.report.contains("cutoff_choice"));
  EXPECT_EQ(smooth(input, {"--cutoff", "auto", "--steps", "0"}).exit_code, 0);
  EXPECT_EQ(smooth(input, {"--cutoff", "auto"}).exit_code, 0);
  EXPECT_EQ(smooth(input, {"--cutoff", "auto", "--time-step", "1"}).exit_code, 2);
  EXPECT_EQ(smooth(input, {"--cutoff", "automatic"}).exit_code, 2);
}

TEST_F(Denoise, IsTheOptionsThatItNames) {
  const std::string input = noisy("torus", {"--rows", "24", "--columns", "60", "--noise", "0.2"});
  const Words named{"--cutoff", "auto",    "--laplacian", "umbrella",     "--twicing",
                    "1",        "--steps", "8",           "--keep-volume"};
  const Smoothed quiet = smooth(input, {"--denoise"});
  ASSERT_EQ(quiet.exit_code, 0) << quiet.err;
  EXPECT_EQ(quiet.X, smooth(input, named).X);
  EXPECT_EQ(quiet.X, smooth(input, named + Words{"--denoise"}).X);
  // Options that are given explicitly take precedence, before and after --denoise.
  const Words own{"--cutoff", "6", "--laplacian", "lagrange", "--twicing", "0", "--steps", "2"};
  const Points given = smooth(input, own + Words{"--keep-volume"}).X;
  EXPECT_EQ(smooth(input, own + Words{"--denoise"}).X, given);
  EXPECT_EQ(smooth(input, Words{"--denoise"} + own).X, given);
  EXPECT_EQ(smooth(input, own + Words{"--denoise=false"}).X, smooth(input, own).X);
  const RunResult refused = run_program(
      {"smooth", input, files_ / "out.ply", "--overwrite", "--denoise", "--time-step", "1"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "--denoise cannot be combined with --time-step"))
      << refused.err;
}

TEST_F(Denoise, TakesTheNoiseAndLeavesTheVolume) {
  const Words torus{"--rows", "24", "--columns", "60"};
  const std::string truth = noisy("torus", torus) + ".truth.ply";
  std::filesystem::copy_file(files_ / "torus.ply", truth);
  const auto distance = [&](const std::string& mesh) {
    const json figures = json::parse(run_program({"compare", mesh, truth, "--json"}).out);
    return figures["surface_distance"]["a_to_b"]["rms"].get<double>();
  };
  for (const char* noise : {"0.05", "0.3"}) {
    const std::string input = noisy("torus", torus + Words{"--noise", noise});
    const double before = distance(input);
    const Smoothed result = smooth(input, {"--denoise"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(distance(files_ / "out.ply"), 0.35 * before) << noise;
    const double volume = result.report["before"]["volume"];
    EXPECT_NEAR(result.report["after"]["volume"].get<double>() / volume, 1, 1e-12) << noise;
  }
}

/// The median angle between neighbouring triangles at X (#V x 3), radians.
double median_turn(const Points& X, const Mesh& mesh) {
  const Topology topology = build_topology(X, triangulate(mesh).F);
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  std::vector<double> turns(angles.size());
  std::ranges::transform(angles, turns.begin(),
                         [](double angle) { return std::numbers::pi - angle; });
  const auto middle = turns.begin() + std::ssize(turns) / 2;
  std::ranges::nth_element(turns, middle);
  return *middle;
}

/// The steps between the slices of a scanned bone are alike over some edges.
TEST_F(Denoise, SmoothsTheSlicesOfAScanner) {
  const Mesh scan = read_mesh(project_file("data/femur.off")).mesh();
  const Smoothed bone = smooth(project_file("data/femur.off"), {"--denoise"});
  ASSERT_EQ(bone.exit_code, 0) << bone.err;
  EXPECT_EQ(bone.report["cutoff_choice"]["kind"], "correlated");
  EXPECT_GE(bone.report["cutoff_choice"]["correlated_edges"].get<double>(), 2);
  EXPECT_TRUE(contains(bone.err, "edges apart is correlated")) << bone.err;
  EXPECT_LT(median_turn(bone.X, scan), 0.3 * median_turn(scan.X, scan));
  // The triangles have angles down to half a degree.
  EXPECT_EQ(bone.report["after"]["folded_hinges"], bone.report["before"]["folded_hinges"]);
}

TEST_F(Denoise, LeavesAMeshWithoutNoiseAsItIs) {
  const std::vector<std::pair<std::string, Words>> shapes{
      {"torus", {"--rows", "24", "--columns", "60"}},
      {"icosphere", {"--subdivide", "3"}},
      {"icosphere", {"--subdivide", "4"}},
      {"icosahedron", {"--subdivide", "3"}},
      {"cube", {"--subdivide", "4"}},
      {"cube", {}},
      {"cubesphere", {"--subdivide", "4"}},
      {"cylinder", {}},
      {"catenoid", {}},
      {"plane", {}},
      {"hexagon", {"--subdivide", "4"}}};
  for (const auto& [shape, options] : shapes) {
    SCOPED_TRACE(shape);
    const std::string input = noisy(shape, options);
    const Smoothed clean = smooth(input, {"--denoise"});
    ASSERT_EQ(clean.exit_code, 0) << clean.err;
    EXPECT_EQ(clean.report["cutoff_choice"]["kind"], "none") << clean.err;
    EXPECT_EQ(clean.report["cutoff_choice"]["cutoff"], 0);
    EXPECT_TRUE(contains(clean.err, "no noise was found")) << clean.err;
    EXPECT_TRUE(read_bytes(files_ / "out.ply") == read_bytes(input));
    const Smoothed told = smooth(input, {"--denoise", "--cutoff", "4"});
    EXPECT_GT(told.report["flow"]["solves"], 0);
  }
}

TEST_F(Denoise, KeepsCreasesWhereThatLeavesLess) {
  const Words cube{"--subdivide", "4"};
  const std::string truth = noisy("cube", cube) + ".truth.ply";
  std::filesystem::copy_file(files_ / "cube.ply", truth);
  const std::string input = noisy("cube", cube + Words{"--noise", "0.1"});
  const Smoothed kept = smooth(input, {"--denoise"});
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_LT(degrees_off(truth), 1);
  const json& choice = kept.report["cutoff_choice"];
  const double angle = choice["keep_sharp"];
  EXPECT_TRUE(
      contains(kept.err, fmt::format("of more than {:.0f} degrees are kept; without", angle)))
      << kept.err;
  EXPECT_EQ(kept.report["options"]["laplacian"], "crouzeix-raviart");
  const Smoothed named =
      smooth(input, {"--cutoff", fmt::format("{}u", choice["cutoff"].get<double>()), "--steps", "8",
                     "--keep-sharp", fmt::format("{}", angle), "--first-stage", "normals",
                     "--keep-volume"});
  EXPECT_LT((named.X - kept.X).norm(), 1e-9);
  // Values that --denoise sets itself change nothing, and others take precedence.
  const Smoothed same = smooth(input, {"--denoise", "--laplacian", "umbrella", "--cutoff", "auto"});
  EXPECT_EQ(same.X, kept.X);
  const Smoothed rounded = smooth(input, {"--denoise", "--laplacian", "lagrange"});
  EXPECT_FALSE(rounded.report["cutoff_choice"].contains("keep_sharp"));
  EXPECT_GT(degrees_off(truth), 2);
  const Smoothed told = smooth(input, {"--denoise", "--keep-sharp", "20"});
  EXPECT_FALSE(told.report["cutoff_choice"].contains("keep_sharp"));
  EXPECT_LT(degrees_off(truth), 1);
}

TEST_F(Denoise, KeepsCreasesUnderNoiseWithLightTails) {
  const Mesh cube = make_shape("cube", {.subdivide = 5});
  const Triangles F = triangulate(cube).F;
  const std::string truth = files_ / "truth.ply", input = files_ / "uniform.ply";
  write_mesh(cube, truth);
  for (const double deviation : {0.2, 0.4}) {
    Mesh noisy = cube;
    RandomNumbers random(1);
    const double edge = mean_edge_length(cube.X, build_topology(cube.X, F).E);
    for (double& x : noisy.X.reshaped()) {
      x += std::sqrt(12.0) * deviation * edge * (random.uniform() - 0.5);
    }
    write_mesh(noisy, input, {.overwrite = true});
    const Smoothed denoised = smooth(input, {"--denoise"});
    ASSERT_EQ(denoised.exit_code, 0) << denoised.err;
    EXPECT_TRUE(denoised.report["cutoff_choice"].contains("keep_sharp")) << denoised.err;
    EXPECT_LT(degrees_off(truth), 2) << deviation;
  }
}

TEST_F(Denoise, RemovesNoiseThatIsOnlyOnOneHalf) {
  const Mesh cube = make_shape("cube", {.subdivide = 5});
  const Triangles F = triangulate(cube).F;
  const double edge = mean_edge_length(cube.X, build_topology(cube.X, F).E);
  const std::string truth = files_ / "truth.ply", input = files_ / "half.ply";
  write_mesh(cube, truth);
  Mesh noisy = cube;
  RandomNumbers random(1);
  for (Eigen::Index v = 0; v < cube.X.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3 && cube.X(v, 0) > 0; ++axis) {
      noisy.X(v, axis) += 0.2 * edge * random.normal();
    }
  }
  write_mesh(noisy, input);
  const Smoothed denoised = smooth(input, {"--denoise"});
  ASSERT_EQ(denoised.exit_code, 0) << denoised.err;
  EXPECT_LT(degrees_off(truth), 1.5);
}

/// Half of the noise of scanners is often independent, and half correlated. Of a shape without
/// creases and one with them, at most a fifth of the normals' error is left.
TEST_F(Denoise, RemovesIndependentNoiseThatIsMixedWithCorrelatedNoise) {
  const std::string truth = files_ / "truth.ply", input = files_ / "mixed.ply";
  for (const Mesh& shape : {make_shape("torus", {.ratio = 2.5, .rows = 48, .columns = 120}),
                            make_shape("cube", {.subdivide = 5})}) {
    State state(shape);
    Mesh mesh = mesh_from_triangles(state.X, state.topology.F);
    write_mesh(mesh, truth, {.overwrite = true});
    add_mixed_noise(state, 0.2);
    mesh.X = state.X;
    write_mesh(mesh, input, {.overwrite = true});
    smooth(input, {"--steps", "0"});
    const double before = degrees_off(truth);
    const Smoothed denoised = smooth(input, {"--denoise"});
    ASSERT_EQ(denoised.exit_code, 0) << denoised.err;
    const json& choice = denoised.report["cutoff_choice"];
    EXPECT_EQ(choice["kind"], "correlated") << denoised.err;
    EXPECT_NEAR(choice["independent_share"], 0.5, 0.25);
    EXPECT_TRUE(contains(denoised.err, "with independent noise")) << denoised.err;
    EXPECT_LT(degrees_off(truth), 0.2 * before) << denoised.err;
  }
}

/// In long bands, the edges of a small cube look like noise.
TEST_F(Denoise, FindsIndependentNoiseOnACube) {
  for (const char* deviation : {"0.1", "0.2", "0.3", "0.4"}) {
    const std::string cube = noisy("cube", {"--subdivide", "5", "--noise", deviation});
    const Smoothed denoised = smooth(cube, {"--denoise"});
    EXPECT_EQ(denoised.report["cutoff_choice"]["kind"], "independent") << denoised.err;
  }
}

TEST_F(Denoise, DoesTheSameInABatch) {
  const std::string input = noisy("cube", {"--subdivide", "4", "--noise", "0.2"});
  ASSERT_EQ(run_program({"smooth", input, files_ / "one.ply", "--denoise"}).exit_code, 0);
  ASSERT_EQ(run_program({"smooth", input, "--out-dir", files_ / "batch", "--denoise"}).exit_code,
            0);
  const std::string name = std::filesystem::path(input).filename();
  EXPECT_EQ(read_mesh(std::filesystem::path(files_ / "batch") / name).mesh().X,
            read_mesh(files_ / "one.ply").mesh().X);
}

TEST_F(Denoise, SmoothsStepsLikeSixteenStepsAndSaysSo) {
  Mesh mesh = make_shape("icosphere", {.subdivide = 4});
  const double step = 0.025;  // 0.35 edges
  mesh.X = (mesh.X / step).array().round() * step;
  std::string text;
  for (const auto& x : mesh.X.rowwise()) {
    text += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
  }
  const Triangles F = triangulate(mesh).F;
  for (const auto& x : F.rowwise()) {
    text += fmt::format("f {} {} {}\n", x[0] + 1, x[1] + 1, x[2] + 1);
  }
  const std::string input = files_ / "steps.obj";
  write_bytes(input, text);
  const Smoothed plain = smooth(input, {"--keep-volume", "--steps", "16"});
  const Smoothed denoised = smooth(input, {"--denoise"});
  ASSERT_EQ(denoised.exit_code, 0) << denoised.err;
  EXPECT_EQ(denoised.report["cutoff_choice"]["kind"], "steps");
  EXPECT_TRUE(contains(denoised.err, "on few levels")) << denoised.err;
  EXPECT_LT((denoised.X - plain.X).norm(), 1e-6);
}

TEST_F(Denoise, KeepsCreasesUnderTexturesWithLittleSliding) {
  const Mesh truth = make_shape("cube", {.subdivide = 4});
  const Mesh mesh = read_mesh(noisy("cube", {"--subdivide", "4", "--noise", "0.2"})).mesh();
  std::string text;
  for (const auto& x : mesh.X.rowwise()) {
    text += fmt::format("v {} {} {}\nvt {} {}\n", x[0], x[1], x[2], x[0] + x[2], x[1]);
  }
  const Triangles F = triangulate(mesh).F;
  for (const auto& x : F.rowwise()) {
    text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", x[0] + 1, x[1] + 1, x[2] + 1);
  }
  const std::string input = files_ / "textured.obj";
  write_bytes(input, text);
  const auto off_truth = [&](const Smoothed& result) { return (result.X - truth.X).norm(); };
  const Smoothed kept = smooth(input, {"--denoise"});
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_TRUE(kept.report["cutoff_choice"].contains("keep_sharp"));
  EXPECT_EQ(kept.report["options"]["tangential"], "first");
  EXPECT_TRUE(contains(kept.err, "relaxation only in the first steps")) << kept.err;
  const Smoothed slid = smooth(input, {"--denoise", "--tangential", "relax"});
  EXPECT_EQ(slid.report["options"]["tangential"], "relax");
  EXPECT_LT(off_truth(kept), 0.9 * off_truth(slid));
  const Smoothed stiff = smooth(input, {"--denoise", "--tangential", "none"});
  EXPECT_EQ(stiff.report["options"]["tangential"], "none");
}

TEST_F(Denoise, KeepsNoVolumeWhereNoneCanBe) {
  const std::string open = noisy("cylinder", {"--noise", "0.2"});
  EXPECT_EQ(smooth(open, {"--denoise"}).exit_code, 0);
  EXPECT_EQ(smooth(open, {"--denoise", "--keep-volume"}).exit_code, 4);
  const std::string closed = noisy("icosphere", {"--subdivide", "3", "--noise", "0.2"});
  EXPECT_EQ(smooth(closed, {"--denoise", "--max-move", "0.1e"}).exit_code, 0);
}

}  // namespace
}  // namespace ibmfair::test
