// `ibmfair smooth` as its users run it, on generated shapes and, if the collection of real meshes
// is present, on real meshes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/measure/sphere_fit.h"
#include "ibmfair/mesh/geometry.h"
#include "support/files.h"
#include "support/run_program.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// Runs `smooth` and returns its report.
json smooth(const std::string& input, const std::string& output,
            std::vector<std::string> options = {}, int expected_exit = 0) {
  options.insert(options.begin(), {"smooth", input, output, "--json", "--overwrite", "--quiet"});
  const RunResult run = run_program(options);
  EXPECT_EQ(run.exit_code, expected_exit) << input << "\n" << run.err;
  return run.out.empty() ? json() : json::parse(run.out);
}

std::string made(const TemporaryDirectory& directory, std::vector<std::string> arguments,
                 const std::string& name) {
  std::string path = directory / name;
  arguments.insert(arguments.begin(), "make");
  arguments.insert(arguments.begin() + 2, path);
  const RunResult run = run_program(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return path;
}

/// The deviation from the best-fit sphere: if the sampling is uneven, the mean of the vertices is
/// not the sphere's centre.
double radius_deviation(const std::string& path) {
  return fit_sphere(read_mesh(path).mesh().X).deviation;
}

TEST(Smooth, ReproducesFigure9) {  // [W07] Figure 9
  const TemporaryDirectory directory;
  const std::string ico = made(directory, {"icosahedron", "--subdivide", "4"}, "ico.ply");
  const std::string refined =
      made(directory, {"icosahedron", "--subdivide", "4", "--refine-face", "0"}, "refined.ply");
  const std::string out = directory / "out.ply";
  const std::vector<std::string> published{"--plain",     "--metric",    "identity",
                                           "--time-step", "0.1",         "--steps",
                                           "10",          "--laplacian", "crouzeix-raviart"};

  const json plain = smooth(ico, out, published);
  EXPECT_NEAR(radius_deviation(out), 1.2e-3, 1e-4);
  EXPECT_EQ(plain["flow"]["factorizations"], 1);
  EXPECT_EQ(plain["options"]["total_time"], 1.0);

  auto without_mass = published;
  without_mass.emplace_back("--no-mass");
  smooth(refined, out, without_mass);
  EXPECT_GT(radius_deviation(out), 2e-2);

  const std::vector<std::string> guarded{"--laplacian", "lagrange", "--cutoff",
                                         "40",          "--steps",  "8"};
  json report = smooth(ico, out, guarded);
  EXPECT_LE(radius_deviation(out), 1e-4);
  EXPECT_LE(report["flow"]["solves"], 12);
  report = smooth(refined, out, guarded);
  EXPECT_LE(radius_deviation(out), 2e-4);
}

TEST(Smooth, DenoisesATorusAsWellAsTheDesignAsks) {
  const TemporaryDirectory directory;
  const std::string noisy = made(
      directory, {"torus", "--ratio", "2.5", "--rows", "128", "--columns", "320", "--noise", "0.2"},
      "torus.ply");
  const std::string out = directory / "out.ply";
  smooth(noisy, out, {"--cutoff", "12", "--steps", "8"});
  const State state(read_mesh(out).mesh());
  double squared = 0;
  for (const auto x : state.X.rowwise()) {
    squared += std::pow(std::hypot(std::hypot(x[0], x[1]) - 1, x[2]) - 0.4, 2);
  }
  EXPECT_LE(std::sqrt(squared / static_cast<double>(state.X.rows())), 3.9e-4);
  const Points normals = triangle_normals(state.X, state.topology.F);
  double angles = 0;
  for (Eigen::Index t = 0; t < normals.rows(); ++t) {
    const Vec3 x = (state.X.row(state.topology.F(t, 0)) + state.X.row(state.topology.F(t, 1)) +
                    state.X.row(state.topology.F(t, 2))) /
                   3;
    const Vec3 axis = Vec3(x[0], x[1], 0).normalized();
    const double cosine = normals.row(t).dot((x - axis).normalized());
    EXPECT_GT(cosine, 0) << "triangle " << t << " is flipped";
    angles += std::acos(std::min(1.0, cosine));
  }
  EXPECT_LE(angles / static_cast<double>(normals.rows()) * 180 / M_PI, 0.5);
}

/// The hinges sharper than ten degrees, each given by its edge.
std::set<std::pair<Index, Index>> folds(const State& state) {
  std::set<std::pair<Index, Index>> found;
  const Eigen::VectorXd angles = dihedral_angles(state.X, state.topology.H);
  for (Eigen::Index h = 0; h < angles.size(); ++h) {
    if (angles[h] < 10 * M_PI / 180) {
      found.insert(std::minmax(state.topology.H(h, 0), state.topology.H(h, 1)));
    }
  }
  return found;
}

/// Some noises have spots that hold up the flow and are slowed down for a while. With the third and
/// the fourth of these noises, the spots would bend the surface around them if they were left
/// behind.
TEST(Smooth, NoisesEndAlikeWhateverHasToBeSlowedDown) {
  const TemporaryDirectory directory;
  const std::string out = directory / "out.ply";
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const std::string seed : {"2", "3", "5", "7"}) {
    const std::string noisy = made(directory,
                                   {"torus", "--ratio", "2.5", "--rows", "80", "--columns", "200",
                                    "--noise", "0.3", "--seed", seed, "--overwrite"},
                                   "noisy.ply");
    smooth(noisy, out, {"--cutoff", "26", "--twicing", "10", "--keep-volume"});
    const RunResult compared = run_program({"compare", out, "--torus", "1,0.4", "--json"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    const double distance = json::parse(compared.out)["exact_surface"]["vertex_distance"]["rms"];
    least = std::min(least, distance);
    most = std::max(most, distance);
  }
  EXPECT_LT(most, 1.4 * least);
}

/// Checks that the energy never rises, that no fold appears, and that closed meshes keep their
/// volume where the cut-off is short.
void expect_promises_kept(const std::vector<std::string>& paths, const std::string& cutoff) {
  const TemporaryDirectory directory;
  for (const std::string& path : paths) {
    SCOPED_TRACE(fmt::format("{} at {}", path, cutoff));
    const std::string out = directory / ("out" + path.substr(path.rfind('.')));
    const json report = smooth(path, out, {"--cutoff", cutoff});
    double energy = report["flow"]["energy_before"];
    for (const json& step : report["steps"]) {
      EXPECT_LE(step["energy"].get<double>(), energy);
      energy = step["energy"];
    }
    const MeshFile before = read_mesh(path), after = read_mesh(out);
    ASSERT_EQ(before.mesh().faces.corner, after.mesh().faces.corner);
    EXPECT_TRUE(after.mesh().X.allFinite());
    const State first(before.mesh());
    State last = first;  // the same triangles, cut as before
    last.X = after.mesh().X;
    for (const auto& edge : folds(last)) {
      EXPECT_TRUE(folds(first).contains(edge)) << edge.first << "-" << edge.second;
    }
    const double change =
        report["after"]["volume"].get<double>() / report["before"]["volume"].get<double>() - 1;
    if (cutoff == "4" && first.topology.boundary_loops.empty()) {
      EXPECT_LT(std::abs(change), 0.02);
    }
  }
}

class SmoothOnRealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(SmoothOnRealMeshes, KeepsItsPromises) {
  const TemporaryDirectory directory;
  std::vector<std::string> paths = project_meshes();
  paths.push_back(made(directory, {"torus", "--noise", "0.2"}, "noisy.obj"));
  paths.push_back(made(directory, {"cube", "--subdivide", "4", "--noise", "0.1"}, "edges.off"));
  expect_promises_kept(paths, GetParam());
}

TEST_P(SmoothOnRealMeshes, KeepsItsPromisesOnTheSharedMeshes) {
  std::vector<std::string> paths = shared_meshes("models");
  for (const std::string& path : shared_meshes("denoise")) {
    if (path.find("noisy") != std::string::npos) {
      paths.push_back(path);
    }
  }
  if (paths.empty()) {
    GTEST_SKIP() << "no ../shared/meshes";
  }
  expect_promises_kept(paths, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Cutoffs, SmoothOnRealMeshes, testing::Values("4", "8", "20"));

void expect_few_factorizations(const std::string& path, int factorizations, std::size_t steps,
                               const std::vector<std::string>& more = {"--steps", "16"}) {
  SCOPED_TRACE(path);
  const TemporaryDirectory directory;
  const std::string out = directory / ("out" + path.substr(path.rfind('.')));
  std::vector<std::string> options{"--cutoff", "4", "--solver", "multifrontal"};
  options.insert(options.end(), more.begin(), more.end());
  const json report = smooth(path, out, options);
  EXPECT_LE(report["flow"]["factorizations"], factorizations);
  EXPECT_LE(report["steps"].size(), steps);
}

/// One factorization is enough for a smooth mesh and 16 steps. With fewer, longer steps, the first
/// one is shorter; where there are needles and folds, as on the femur, the first ones are.
TEST(Smooth, TakesFewFactorizations) {
  expect_few_factorizations(project_file("data/bunny.obj"), 1, 16);
  expect_few_factorizations(project_file("data/bunny.obj"), 2, 9, {});
  expect_few_factorizations(project_file("data/femur.off"), 7, 18, {});
  expect_few_factorizations(project_file("data/femur.off"), 7, 18);
}

TEST(Smooth, TakesFewFactorizationsOnThePapersMeshes) {
  const auto hand = shared_mesh("models/hand_24192.off");
  const auto dinosaur = shared_mesh("models/dinosaur_44928.off");
  if (!hand || !dinosaur) GTEST_SKIP() << "no ../shared/meshes";
  expect_few_factorizations(*hand, 1, 16);
  expect_few_factorizations(*dinosaur, 3, 18);
}

TEST(Smooth, SameBytesForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  const std::string noisy =
      made(directory, {"icosphere", "--subdivide", "5", "--noise", "0.2"}, "noisy.obj");
  smooth(noisy, directory / "one.obj", {"--threads", "1"});
  smooth(noisy, directory / "two.obj", {"--threads", "2"});
  EXPECT_EQ(read_bytes(directory / "one.obj"), read_bytes(directory / "two.obj"));
}

TEST(Smooth, CutoffDoesNotDependOnTheScale) {
  const TemporaryDirectory directory;
  const std::vector<std::string> shape{"icosphere", "--subdivide", "4", "--noise", "0.1"};
  auto large = shape;
  large.insert(large.end(), {"--scale", "1000"});
  smooth(made(directory, shape, "small.ply"), directory / "small_out.ply", {"--cutoff", "8"});
  smooth(made(directory, large, "large.ply"), directory / "large_out.ply", {"--cutoff", "8"});
  const Points X = read_mesh(directory / "small_out.ply").mesh().X;
  const Points Y = read_mesh(directory / "large_out.ply").mesh().X;
  EXPECT_LT((1000 * X - Y).cwiseAbs().maxCoeff(), 1e-9 * 1000);
}

TEST(Smooth, FixedAndUnmaskedVerticesKeepTheirText) {
  const TemporaryDirectory directory;
  const std::string noisy =
      made(directory, {"icosphere", "--subdivide", "3", "--noise", "0.2"}, "noisy.obj");
  write_bytes(directory / "fixed.txt", "0, 1 2 # the first ones\n17\n\n100");
  smooth(noisy, directory / "out.obj", {"--fix", directory / "fixed.txt"});
  const Points X = read_mesh(noisy).mesh().X, Y = read_mesh(directory / "out.obj").mesh().X;
  for (const Index v : {0, 1, 2, 17, 100}) {
    EXPECT_EQ(X.row(v), Y.row(v));
  }
  EXPECT_NE(X.row(3), Y.row(3));

  // The same test with an OBJ group: all vertices except those of the group's faces stay.
  std::string text = read_bytes(noisy);
  const auto first_face = text.find("\nf ");
  const auto tenth = text.find("\nf ", first_face + 200);
  text.insert(tenth, "\ng others");
  text.insert(first_face, "\ng patch");
  write_bytes(directory / "groups.obj", text);
  const MeshFile groups = read_mesh(directory / "groups.obj");
  const auto mask = groups.vertex_mask("others");
  smooth(directory / "groups.obj", directory / "masked.obj", {"--mask", "others"});
  const Points Z = read_mesh(directory / "masked.obj").mesh().X;
  std::int64_t kept = 0;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    kept += X.row(v) == Z.row(v) ? 1 : 0;
    if (!mask[v]) {
      EXPECT_EQ(X.row(v), Z.row(v));
    }
  }
  EXPECT_EQ(kept, std::count(mask.begin(), mask.end(), 0));
  EXPECT_GT(kept, 0);
}

TEST(Smooth, ZeroStepsCopyTheFile) {
  const TemporaryDirectory directory;
  for (const std::string extension : {"obj", "ply", "off"}) {
    const std::string in = made(directory, {"torus", "--noise", "0.1"}, "in." + extension);
    const std::string out = directory / ("out." + extension);
    smooth(in, out, {"--steps", "0"});
    EXPECT_EQ(read_bytes(in), read_bytes(out)) << extension;
  }
}

TEST(Smooth, StrictRefusesDefectsAndWritesNothing) {
  const TemporaryDirectory directory;
  write_bytes(directory / "fan.off",
              "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n");
  const auto entries = directory.entries();
  const RunResult strict =
      run_program({"smooth", directory / "fan.off", directory / "out.off", "--strict"});
  EXPECT_EQ(strict.exit_code, 4);
  EXPECT_NE(strict.err.find("0-1"), std::string::npos) << strict.err;
  EXPECT_EQ(directory.entries(), entries);
  const json report = smooth(directory / "fan.off", directory / "out.off");
  EXPECT_EQ(report["defects"]["non_manifold_edges"][0], (json{0, 1}));
}

TEST(Smooth, BadOptionsAreUsageErrors) {
  const TemporaryDirectory directory;
  const std::string in = made(directory, {"icosphere"}, "in.off");
  const std::string out = directory / "out.off";
  const auto entries = directory.entries();
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--cutoff", "0"},
                                             {"--cutoff", "-1"},
                                             {"--cutoff", "8x"},
                                             {"--cutoff", "nan"},
                                             {"--steps", "-1"},
                                             {"--steps", "1.5"},
                                             {"--time-step", "1", "--cutoff", "2"},
                                             {"--time-step", "0"},
                                             {"--max-move", "0"},
                                             {"--metric", "euclid"},
                                             {"--boundary", "loose"},
                                             {"--laplacian", "cotan"},
                                             {"--newton-iterations", "0"},
                                             {"--mask", "nothing"}}) {
    std::vector<std::string> arguments{"smooth", in, out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 2) << options[0] << " " << options[1] << ": " << run.err;
    EXPECT_NE(run.err.find(options[options[0] == "--mask" ? 1 : 0]), std::string::npos) << run.err;
    EXPECT_EQ(directory.entries(), entries);
  }
  write_bytes(directory / "bad.txt", "1 2\n3 x\n");
  const RunResult run = run_program({"smooth", in, out, "--fix", directory / "bad.txt"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("bad.txt:2"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace ibmfair::test
