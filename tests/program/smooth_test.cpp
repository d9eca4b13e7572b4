// `smooth`: its forecasts and reports are right, and it keeps to its limits.
#include <regex>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/io/mesh_file.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/solvers.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::contains;
using test::figures;
using test::made;
using test::run_program;
using test::RunResult;
using test::solvers;
using test::TemporaryDirectory;
using test::Words;
using test::operator+;

/// A mesh for which a factor takes some 100 MB, and conjugate gradients take a fifth of this
/// memory.
std::string mesh_with_a_large_factor(const TemporaryDirectory& directory) {
  std::string mesh = directory / "large.ply";
  EXPECT_EQ(run_program({"make", "torus", mesh, "--rows", "120", "--columns", "300"}).exit_code, 0);
  return mesh;
}

TEST(Smooth, ADryRunForecastsEverySolverAndWritesNothing) {
  const TemporaryDirectory directory;
  const std::string in = mesh_with_a_large_factor(directory);
  const json found =
      figures({"smooth", in, directory / "out.ply", "--dry-run", "--quiet"})["forecast"];
  EXPECT_EQ(found["unknowns"], 36000);
  ASSERT_EQ(found["solvers"].size(), solvers().size());
  for (const json& solver : found["solvers"]) {
    EXPECT_GT(solver["seconds"], 0) << solver;
    EXPECT_GT(solver["bytes"], 36000 * 100) << solver;
    EXPECT_EQ(solver["factor_entries"] > 0, solver["solver"] != "cg");
  }
  EXPECT_EQ(directory.entries(), 1U);
  const std::string before = test::read_bytes(in);
  EXPECT_EQ(run_program({"smooth", in, in, "--dry-run"}).exit_code, 0);  // OUT exists
  EXPECT_EQ(test::read_bytes(in), before);
}

TEST(Smooth, OneThreadKeepsOneCoreBusyAtMost) {
  const TemporaryDirectory directory;
  const std::string in = mesh_with_a_large_factor(directory);
  double elapsed = 0, used = 0;
  {
    const Stopwatch watch(elapsed);
    used =
        run_program({"smooth", in, directory / "out.ply", "--quiet", "--threads", "1"}).cpu_seconds;
  }
  EXPECT_GT(used, 0);
  EXPECT_LE(used, 1.1 * elapsed);
}

TEST(Smooth, StagesTakeNoMoreThanTheRun) {
  const TemporaryDirectory directory;
  const std::string in = mesh_with_a_large_factor(directory), out = directory / "out.ply";
  for (const std::string& solver : solvers()) {
    for (const Words& options : {Words{}, Words{"--twicing", "1"}, Words{"--plain"}}) {
      double all = 0;
      json found;
      {
        const Stopwatch watch(all);
        found = figures(
            Words{"smooth", in, out, "--overwrite", "--quiet", "--steps", "2", "--solver", solver} +
            options);
      }
      double sum = 0;
      for (const auto& [stage, seconds] : found["seconds"].items()) {
        EXPECT_GE(seconds.get<double>(), 0) << stage;
        sum += seconds.get<double>();
      }
      EXPECT_LE(sum, all) << solver;
    }
  }
}

/// The law also holds if vertices are fixed, so that the flow computes the energies of a part of
/// the mesh only.
TEST(Smooth, EnergiesAreThoseOfTheWholeMesh) {
  const TemporaryDirectory directory;
  const std::string out = directory / "out.ply";
  for (const char* shape : {"torus", "cylinder"}) {
    const std::string in = directory / "in.ply";
    ASSERT_EQ(run_program({"make", shape, in, "--noise", "0.2", "--overwrite"}).exit_code, 0);
    for (const Words& options :
         {Words{}, Words{"--twicing", "1"}, Words{"--laplacian", "lagrange"},
          Words{"--boundary", "fixed"}, Words{"--boundary", "fixed", "--laplacian", "lagrange"}}) {
      const json found = figures(Words{"smooth", in, out, "--overwrite", "--quiet"} + options);
      for (const auto& [state, mesh] : {std::pair{"before", in}, std::pair{"after", out}}) {
        const json alone = figures(Words{"smooth", mesh, directory / "same.ply", "--overwrite",
                                         "--quiet", "--steps", "0"} +
                                   options);
        const double energy = alone["before"]["energy"];
        EXPECT_NEAR(found[state]["energy"].get<double>(), energy, 1e-9 * energy)
            << shape << ", " << state;
      }
    }
  }
}

TEST(Smooth, KeepsToTheMemoryItIsGiven) {
  const TemporaryDirectory directory;
  const std::string in = mesh_with_a_large_factor(directory), out = directory / "out.ply";
  const Words words{"smooth", in, out, "--cutoff", "40"};
  const auto forecast = [&](const Words& more) {
    return figures(words + Words{"--dry-run", "--quiet"} + more)["forecast"];
  };
  const json free = forecast({});
  EXPECT_EQ(free["solver"], "multifrontal");
  // With a limit halfway between the two solvers' memory, only one of the solvers fits.
  const double between =
      (free["solvers"][0]["bytes"].get<double>() + free["solvers"][1]["bytes"].get<double>()) / 2;
  const Words limit{"--memory", std::to_string(between)};
  EXPECT_EQ(forecast(limit)["solver"], "cg");

  for (const std::string& solver : solvers()) {
    if (solver == "cg") continue;
    const RunResult refused = run_program(words + limit + Words{"--solver", solver});
    EXPECT_EQ(refused.exit_code, 5);
    EXPECT_TRUE(contains(refused.err, "--solver cg fits")) << refused.err;
  }
  const RunResult hopeless = run_program(words + Words{"--memory", "1M"});
  EXPECT_EQ(hopeless.exit_code, 5);
  EXPECT_TRUE(contains(hopeless.err, "the limit is 1 MB")) << hopeless.err;
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(Smooth, ALengthThatCannotBeReadIsAnsweredWithTheWaysToWriteOne) {
  const std::string mesh = made({"icosahedron"});
  for (const std::string length : {"five", "5 %", "5mm", "-1", "0e", "nan", "1e400", ""}) {
    const RunResult run =
        run_program({"smooth", "-", "-", "--format", "off", "--cutoff=" + length}, {.input = mesh});
    EXPECT_EQ(run.exit_code, 2) << length;
    if (length.empty()) continue;  // the parser's own message
    EXPECT_TRUE(contains(run.err, "--cutoff: '" + length + "' is not a positive length; write 8e"))
        << run.err;
  }
}

TEST(Smooth, TellsWhereTheDefaultCutoffIsAsLongAsTheMesh) {
  const std::string told = "the whole shape is smoothed";
  const Words smooth{"smooth", "-", "-", "--format", "off"};
  const std::string few = made({"icosahedron"}), many = made({"icosphere", "--subdivide", "4"});
  EXPECT_TRUE(contains(run_program(smooth, {.input = few}).err, told));
  EXPECT_FALSE(contains(run_program(smooth, {.input = many}).err, told));
  const Words asked = smooth + Words{"--cutoff", "8"};
  EXPECT_FALSE(contains(run_program(asked, {.input = few}).err, told));
}

/// A closed plate of 13 x 13 x 0.1 with edges of 1: two sheets of squares, and a rim.
std::string thin_plate() {
  constexpr int n = 14;
  std::string vertices, faces;
  const auto at = [](int sheet, int i, int j) { return (sheet * n + i) * n + j; };
  int count = 0;
  const auto face = [&](int a, int b, int c, int d) {
    faces += fmt::format("4 {} {} {} {}\n", a, b, c, d);
    ++count;
  };
  for (int sheet = 0; sheet < 2; ++sheet) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        vertices += fmt::format("{} {} {}\n", i, j, sheet == 0 ? -0.05 : 0.05);
      }
    }
  }
  for (int i = 0; i + 1 < n; ++i) {
    face(at(0, i + 1, 0), at(1, i + 1, 0), at(1, i, 0), at(0, i, 0));
    face(at(0, i, n - 1), at(1, i, n - 1), at(1, i + 1, n - 1), at(0, i + 1, n - 1));
    face(at(0, 0, i), at(1, 0, i), at(1, 0, i + 1), at(0, 0, i + 1));
    face(at(0, n - 1, i + 1), at(1, n - 1, i + 1), at(1, n - 1, i), at(0, n - 1, i));
    for (int j = 0; j + 1 < n; ++j) {
      face(at(0, i, j), at(0, i, j + 1), at(0, i + 1, j + 1), at(0, i + 1, j));
      face(at(1, i, j), at(1, i + 1, j), at(1, i + 1, j + 1), at(1, i, j + 1));
    }
  }
  return fmt::format("OFF\n{} {} 0\n", 2 * n * n, count) + vertices + faces;
}

TEST(Smooth, WarnsOfEveryClosedMeshWhoseVolumeChangesByMoreThanOnePerCent) {
  const std::string warning = "the volume has changed from";
  const std::string open_sheet =
      made({"plane", "--rows", "32", "--columns", "32", "--noise", "0.1"});
  const std::vector<std::string> meshes{
      made({"torus", "--ratio", "8", "--rows", "8", "--columns", "100", "--noise", "0.1"}),
      made({"torus", "--rows", "48", "--columns", "120", "--noise", "0.1"}),
      made({"cube", "--subdivide", "3"}),
      made({"icosahedron", "--subdivide", "2"}),
      open_sheet,
      thin_plate()};
  const std::vector<Words> options{{},
                                   {"--steps", "16"},
                                   {"--cutoff", "2"},
                                   {"--cutoff", "8", "--twicing", "1"},
                                   {"--keep-volume"},
                                   {"--denoise"}};
  int warned = 0;
  for (const std::string& mesh : meshes) {
    const bool closed = mesh != open_sheet;
    for (const Words& more : options) {
      if (!closed && more == Words{"--keep-volume"}) continue;
      SCOPED_TRACE(fmt::format("{} {}", mesh.size(), fmt::join(more, " ")));
      const TemporaryDirectory directory;
      const RunResult run = run_program(
          Words{"smooth", "-", directory / "out.off", "--json"} + more, {.input = mesh});
      ASSERT_EQ(run.exit_code, 0) << run.err;
      const json report = json::parse(run.out);
      const double change =
          report["after"]["volume"].get<double>() / report["before"]["volume"].get<double>() - 1;
      const bool warns = contains(run.err, warning);
      warned += warns ? 1 : 0;
      EXPECT_EQ(warns, closed && std::abs(change) > 0.01) << run.err;
      EXPECT_EQ(contains(report["warnings"].dump(), warning), warns);
    }
  }
  EXPECT_GT(warned, 4);
}

TEST(Smooth, GivesOneSidedSurfacesNoVolume) {
  for (const test::NamedMesh& mesh : test::nonorientable_meshes()) {
    SCOPED_TRACE(mesh.name);
    const TemporaryDirectory directory;
    const std::string in = directory / "in.off", out = directory / "out.off";
    write_mesh(mesh.mesh, in);
    const RunResult run = run_program({"smooth", in, out});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_FALSE(contains(run.err, "volume")) << run.err;
    const json report =
        json::parse(run_program({"smooth", in, out, "--overwrite", "--json", "-q"}).out);
    EXPECT_TRUE(report["before"]["volume"].is_null() && report["after"]["volume"].is_null());
    const std::string info = run_program({"info", in}).out;
    EXPECT_FALSE(contains(info, "coherent")) << info;
    EXPECT_NE(contains(info, ", closed"), contains(info, "not closed")) << info;
  }
}

TEST(Smooth, TellsWhatBecomesOfTextureCoordinates) {
  const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string textured = plain +
                               "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\n"
                               "f 2/1 3/2 4/3\nf 3/1 1/2 4/3\n";
  const auto said = [&](const Words& options) {
    return run_program(
               Words{"smooth", "-", "-", "--input-format", "obj", "--format", "obj"} + options,
               {.input = textured})
        .err;
  };
  EXPECT_TRUE(contains(said({}), "no tangential relaxation"));
  EXPECT_TRUE(contains(said({"--laplacian", "umbrella"}), "vertices slide within the surface"));
  EXPECT_TRUE(contains(said({"--denoise"}), "less with --tangential keep"));
  EXPECT_FALSE(contains(said({"--tangential", "relax"}), "texture"));
}

TEST(Smooth, TellsHowFarAFlowThatStalledHasSmoothed) {
  // Without mass, a sphere shrinks to a point long before it is smooth at this length.
  const std::string crumpled = made({"icosphere", "--subdivide", "2", "--noise", "1"});
  const RunResult run = run_program(
      {"smooth", "-", "-", "--format", "off", "--cutoff", "100", "--no-mass"}, {.input = crumpled});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  std::smatch lengths;
  ASSERT_TRUE(std::regex_search(
      run.err, lengths, std::regex("up to a wavelength of ([-+.e0-9]+) instead of ([-+.e0-9]+)")))
      << run.err;
  EXPECT_GT(std::stod(lengths[1]), 0);
  EXPECT_LT(std::stod(lengths[1]), std::stod(lengths[2]));
}

TEST(Smooth, TakesEveryMassThatGoesWithItsLaplacian) {
  const std::string rough = made({"icosphere", "--subdivide", "2", "--noise", "0.2"});
  const Words smooth{"smooth", "-", "-", "--format", "off", "--steps", "2"};
  const auto result = [&](const Words& more) {
    const RunResult run = run_program(smooth + more, {.input = rough});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  const Words voronoi{"--laplacian", "lagrange", "--mass", "voronoi"};
  EXPECT_NE(result(voronoi), result({"--laplacian", "lagrange"}));
  EXPECT_EQ(result({"--mass", "none"}), result({"--no-mass"}));
  EXPECT_EQ(result({"--mass", "crouzeix-raviart"}), result({}));
  EXPECT_EQ(run_program(smooth + Words{"--mass", "voronoi"}, {.input = rough}).exit_code, 2);
}

}  // namespace
}  // namespace ibmfair
