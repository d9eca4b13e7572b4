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
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// A smoothed mesh with its report.
struct Smoothed {
  int exit_code = 0;
  std::string err;
  json report;
  Points X;
};

class SmoothFeatures : public testing::Test {
 protected:
  Smoothed smooth(const std::string& input, const Words& options) {
    const RunResult run =
        run_program(Words{"smooth", input, files_ / "out.ply", "--overwrite", "--json"} + options);
    Smoothed result{run.exit_code, run.err, json::parse(run.out, nullptr, false), {}};
    if (run.exit_code == 0) {
      result.X = read_mesh(files_ / "out.ply").mesh().X;
    }
    return result;
  }

  std::string noisy(const std::string& shape, const Words& options) {
    std::string path = files_ / (shape + ".ply");
    const RunResult run = run_program(Words{"make", shape, path, "--overwrite"} + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path;
  }

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

  TemporaryDirectory files_;
};

/// The blunting of the twelve edges of a cube (-1 to 1): the mean distance of the vertices that
/// were on an edge from this edge.
double edge_error(const Points& X, const Points& clean) {
  double sum = 0;
  int count = 0;
  for (Index v = 0; v < X.rows(); ++v) {
    const auto is_face = (clean.row(v).array().abs() - clean.cwiseAbs().maxCoeff()).abs() < 1e-9;
    if (is_face.count() < 2) {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      sum += is_face[axis] ? std::abs(X(v, axis) - clean(v, axis)) : 0;
    }
    ++count;
  }
  return sum / count;
}

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

TEST_F(SmoothFeatures, CutoffAutoIsTheCutoffThatItNames) {
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

TEST_F(SmoothFeatures, CutoffAutoWhereThereIsNothingToChoose) {
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

TEST_F(SmoothFeatures, DenoiseIsTheOptionsThatItNames) {
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

TEST_F(SmoothFeatures, DenoiseTakesTheNoiseAndLeavesTheVolume) {
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

TEST_F(SmoothFeatures, DenoiseLeavesAMeshWithoutNoiseAsItIs) {
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
    EXPECT_EQ(read_bytes(files_ / "out.ply"), read_bytes(input));
    const Smoothed told = smooth(input, {"--denoise", "--cutoff", "4"});
    EXPECT_GT(told.report["flow"]["solves"], 0);
  }
}

TEST_F(SmoothFeatures, DenoiseKeepsCreasesWhereThatLeavesLess) {
  const Words cube{"--subdivide", "4"};
  const std::string truth = noisy("cube", cube) + ".truth.ply";
  std::filesystem::copy_file(files_ / "cube.ply", truth);
  const auto degrees_off = [&] {
    const Words compare{"compare", files_ / "out.ply", truth, "--json"};
    return json::parse(run_program(compare).out)["face_normal_degrees"]["mean"].get<double>();
  };
  const std::string input = noisy("cube", cube + Words{"--noise", "0.1"});
  const Smoothed kept = smooth(input, {"--denoise"});
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_LT(degrees_off(), 1);
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
  EXPECT_GT(degrees_off(), 2);
  const Smoothed told = smooth(input, {"--denoise", "--keep-sharp", "20"});
  EXPECT_FALSE(told.report["cutoff_choice"].contains("keep_sharp"));
  EXPECT_LT(degrees_off(), 1);
}

TEST_F(SmoothFeatures, DenoiseDoesTheSameInABatch) {
  const std::string input = noisy("cube", {"--subdivide", "4", "--noise", "0.2"});
  ASSERT_EQ(run_program({"smooth", input, files_ / "one.ply", "--denoise"}).exit_code, 0);
  ASSERT_EQ(run_program({"smooth", input, "--out-dir", files_ / "batch", "--denoise"}).exit_code,
            0);
  const std::string name = std::filesystem::path(input).filename();
  EXPECT_EQ(read_mesh(std::filesystem::path(files_ / "batch") / name).mesh().X,
            read_mesh(files_ / "one.ply").mesh().X);
}

TEST_F(SmoothFeatures, DenoiseSmoothsStepsLikeSixteenStepsAndSaysSo) {
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

TEST_F(SmoothFeatures, DenoiseKeepsCreasesUnderTexturesWithLittleSliding) {
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

TEST_F(SmoothFeatures, DenoiseKeepsNoVolumeWhereNoneCanBe) {
  const std::string open = noisy("cylinder", {"--noise", "0.2"});
  EXPECT_EQ(smooth(open, {"--denoise"}).exit_code, 0);
  EXPECT_EQ(smooth(open, {"--denoise", "--keep-volume"}).exit_code, 4);
  const std::string closed = noisy("icosphere", {"--subdivide", "3", "--noise", "0.2"});
  EXPECT_EQ(smooth(closed, {"--denoise", "--max-move", "0.1e"}).exit_code, 0);
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
