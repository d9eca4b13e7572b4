// The real program, run as its users run it.
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::contains;
using test::run_program;
using test::RunOptions;
using test::RunResult;
using test::StandardOutput;
using test::TemporaryDirectory;
using test::Words;
using test::operator+;

using std::numbers::pi;

/// The JSON that a run prints; the run must succeed and say nothing else.
json figures(const Words& arguments, const RunOptions& options = {}) {
  const RunResult result = run_program(arguments + Words{"--json"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  json parsed = json::parse(result.out, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << result.out;
  EXPECT_EQ(parsed.value("version", 0), 1);
  return parsed;
}

/// The bytes of a generated shape.
std::string made(const Words& arguments, const std::string& format = "off") {
  const RunResult result = run_program(Words{"make"} + arguments + Words{"-", "--format", format});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

json info_of(const Words& shape) {
  return figures({"info", "-"}, {.input = made(shape)});
}

const std::vector<std::string>& all_commands() {
  static const std::vector<std::string> names{"smooth",  "fill", "holes", "info",
                                              "compare", "make", "batch"};
  return names;
}

TEST(Program, HelpAndVersionGoToStandardOutputAndSucceed) {
  const RunResult help = run_program({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  for (const std::string& command : all_commands()) {
    EXPECT_TRUE(contains(help.out, "  " + command + " ")) << command;
    const RunResult more = run_program({command, "--help"});
    EXPECT_EQ(more.exit_code, 0);
    EXPECT_EQ(more.err, "");
    for (const std::string option :
         {"--help", "--quiet", "--verbose", "--threads", "--dump-config"}) {
      EXPECT_TRUE(contains(more.out, option)) << command << " " << option;
    }
  }
  const RunResult version = run_program({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  for (const std::string part : {"ibmfair ", "Eigen ", "CHOLMOD ", "SuiteSparse ", "BLAS "}) {
    EXPECT_TRUE(contains(version.out, part)) << version.out;
  }
}

struct Misuse {
  Words arguments;
  std::string message;  // a part of it
};

TEST(Program, MisuseIsExplainedWithExitCode2) {
  const std::vector<Misuse> misuses{
      {{}, "no command"},
      {{"--quiet"}, "--quiet"},
      {{"smoth", "a.obj", "b.obj"}, "did you mean 'smooth'"},
      {{"ifno"}, "did you mean 'info'"},
      {{"xyzzy"}, "unknown command 'xyzzy'"},
      {{"info"}, "IN"},
      {{"info", "a.obj", "b.obj"}, "'b.obj'"},
      {{"info", "a.obj", "--shpere"}, "did you mean '--sphere'"},
      {{"info", "--strct"}, "did you mean '--strict'"},
      {{"make", "icosphere", "-", "--subdvide=2"}, "did you mean '--subdivide'"},
      {{"make", "torsu", "-"}, "did you mean 'torus'"},
      {{"make", "torus", "-", "--subdivide", "2"}, "subdivide"},
      {{"make", "icosphere", "-", "--subdivide", "1e3x"}, "--subdivide: '1e3x'"},
      {{"make", "icosphere", "-", "--subdivide", "2.5"}, "--subdivide: '2.5'"},
      {{"make", "icosphere", "-", "--subdivide", "-1"}, "--subdivide: -1"},
      {{"make", "icosphere", "-", "--subdivide", "99999999999999999999"}, "--subdivide"},
      {{"make", "icosphere", "-", "--subdivide", ""}, "--subdivide: ''"},
      {{"make", "icosphere", "-", "--subdivide", "12", "--format", "off"}, "faces"},
      {{"make", "icosphere", "-", "--refine-face", "20", "--format", "off"}, "20"},
      {{"make", "torus", "-", "--rows", "7", "--format", "off"}, "rows"},
      {{"make", "torus", "-", "--ratio", "1", "--format", "off"}, "ratio"},
      {{"make", "plane", "-", "--noise", "nan"}, "--noise: 'nan'"},
      {{"make", "plane", "-", "--noise", "-1"}, "--noise: -1"},
      {{"make", "plane", "-", "--scale", "inf"}, "--scale: 'inf'"},
      {{"make", "plane", "-", "--scale", "0"}, "--scale: 0"},
      {{"make", "plane", "-", "--scale", "0x10"}, "--scale: '0x10'"},
      {{"make", "plane", "-", "--move", "1,2"}, "--move"},
      {{"make", "plane", "-", "--move", "1,2,"}, "--move"},
      {{"make", "plane", "-", "--format", "xyzzy"}, "xyzzy"},
      {{"make", "plane", "-", "--threads", "-1"}, "--threads: -1"},
      {{"make", "plane", "-", "--threads", "1000000"}, "--threads"},
      {{"make", "plane", "-", "--seed", "1", "--seed", "2"}, "--seed"},
      {{"make", "plane", "-", "-q", "-v"}, "--quiet"},
      {{"make", "plane", "-"}, "--format"},
      {{"compare", "a.obj"}, "B"},
      {{"compare", "a.obj", "b.obj", "--sphere", "1"}, "one thing"},
      {{"compare", "-", "-"}, "standard input"},
      {{"compare", "a.obj", "--torus", "1"}, "--torus"},
      {{"compare", "a.obj", "b.obj", "--tolerance", "-1"}, "--tolerance"},
  };
  for (const auto& [arguments, message] : misuses) {
    std::string line;
    for (const std::string& word : arguments) {
      line += word + " ";
    }
    SCOPED_TRACE(line);
    const RunResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("ibmfair: error: ")) << result.err;
    EXPECT_TRUE(contains(result.err, message)) << result.err;
  }
}

TEST(Program, UnreadableInputHasExitCode3AndNamesTheFile) {
  const TemporaryDirectory directory;
  test::write_bytes(directory / "odd.obj", "v 0 0 0\nv 1 0 zero\n");
  test::write_bytes(directory / "empty.ply", "");
  test::write_bytes(directory / "fine.off", made({"cube"}));
  for (const std::string name : {"odd.obj", "empty.ply", "missing.off"}) {
    SCOPED_TRACE(name);
    const std::string path = directory / name;
    for (const Words& arguments :
         {Words{"info", path}, Words{"compare", directory / "fine.off", path},
          Words{"compare", path, "--sphere", "1"}, Words{"smooth", path, directory / "out.off"}}) {
      const RunResult result = run_program(arguments);
      EXPECT_EQ(result.exit_code, 3) << arguments.front();
      EXPECT_EQ(result.out, "");
      EXPECT_TRUE(contains(result.err, name)) << result.err;
    }
  }
  EXPECT_TRUE(contains(run_program({"info", directory / "odd.obj"}).err, "odd.obj:2:"));
  EXPECT_EQ(directory.entries(), 3U);
}

TEST(Program, GeometryThatCannotBeProcessedHasExitCode4) {
  const std::string fin =
      "OFF 5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n";
  const RunResult lenient = run_program({"info", "-"}, {.input = fin});
  EXPECT_EQ(lenient.exit_code, 0) << lenient.err;
  EXPECT_TRUE(contains(lenient.out, "0-1")) << lenient.out;
  const RunResult strict = run_program({"info", "-", "--strict"}, {.input = fin});
  EXPECT_EQ(strict.exit_code, 4);
  EXPECT_TRUE(contains(strict.err, "edges of three or more triangles")) << strict.err;
  EXPECT_EQ(strict.out, lenient.out);  // told all the same

  EXPECT_EQ(run_program({"info", "-", "--sphere"}, {.input = made({"plane"})}).exit_code, 4);
  const std::string line = "OFF 3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n";
  const TemporaryDirectory directory;
  test::write_bytes(directory / "line.off", line);
  EXPECT_EQ(run_program({"compare", directory / "line.off", directory / "line.off"}).exit_code, 4);
}

TEST(Program, OutputThatCannotBeWrittenHasExitCode6AndLeavesNothing) {
  const TemporaryDirectory directory;
  for (const std::string& path :
       {directory / "missing/out.obj", std::string("/proc/out.obj"), directory.path().string()}) {
    SCOPED_TRACE(path);
    EXPECT_EQ(run_program({"make", "cube", path, "--format", "obj", "--overwrite"}).exit_code, 6);
  }
  EXPECT_EQ(directory.entries(), 0U);

  const std::string path = directory / "kept.obj";
  test::write_bytes(path, "mine");
  const RunResult refused = run_program({"make", "cube", path});
  EXPECT_EQ(refused.exit_code, 6);
  EXPECT_TRUE(contains(refused.err, "--overwrite")) << refused.err;
  EXPECT_EQ(test::read_bytes(path), "mine");
  const std::string kept_report = directory / "kept.json";
  test::write_bytes(kept_report, "mine");
  const RunResult report =
      run_program({"info", "-", "--report", kept_report}, {.input = made({"cube"})});
  EXPECT_EQ(report.exit_code, 6);
  EXPECT_EQ(test::read_bytes(kept_report), "mine");
  EXPECT_EQ(run_program({"make", "cube", path, "--overwrite"}).exit_code, 0);
  EXPECT_EQ(run_program({"info", path}).exit_code, 0);
  EXPECT_EQ(directory.entries(), 2U);
}

TEST(Program, StandardOutputThatIsGoneIsAnErrorNotACrash) {
  const std::string cube = made({"cube"});
  for (const StandardOutput output :
       {StandardOutput::closed, StandardOutput::broken_pipe, StandardOutput::full}) {
    for (const Words& arguments :
         {Words{"--help"}, Words{"--version"}, Words{"info", "-"}, Words{"info", "-", "--json"},
          Words{"compare", "-", "--sphere", "1"}, Words{"smooth", "-", "-", "--steps", "0"},
          Words{"make", "icosphere", "-", "--subdivide", "4", "--format", "ply"}}) {
      const RunResult result = run_program(arguments, {.input = cube, .output = output});
      EXPECT_EQ(result.exit_code, 6) << arguments.front() << " " << static_cast<int>(output);
      EXPECT_TRUE(contains(result.err, "standard output")) << result.err;
    }
  }
}

TEST(Program, AnInterruptHasExitCode130AndLeavesNothing) {
  const TemporaryDirectory directory;
  std::string endless = "# a file that goes on\n";
  while (endless.size() < 1U << 20U) {
    endless += "v 0.25 0.5 0.75\n";
  }
  for (const Words& arguments : {Words{"info", "-"}, Words{"smooth", "-", directory / "out.obj"}}) {
    EXPECT_EQ(run_program(arguments, {.input = endless, .signal_number = SIGINT}).exit_code, 130);
    EXPECT_EQ(run_program(arguments, {.input = endless, .signal_number = SIGTERM}).exit_code, 143);
  }
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(Program, TooLittleMemoryHasExitCode5) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  if (!std::filesystem::exists("/usr/bin/prlimit")) {
    GTEST_SKIP() << "no prlimit";
  }
  const RunResult result =
      run_program({"make", "icosphere", "-", "--format", "off", "--subdivide", "9"},
                  {.address_space = std::int64_t{3} << 27U});
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(contains(result.err, "memory")) << result.err;
}

/// A mesh for which a factor takes some 100 MB and conjugate gradients a fifth of that.
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
  ASSERT_EQ(found["solvers"].size(), 2U);
  for (const json& solver : found["solvers"]) {
    EXPECT_GT(solver["seconds"], 0) << solver;
    EXPECT_GT(solver["bytes"], 36000 * 100) << solver;
    EXPECT_EQ(solver["factor_entries"] > 0, solver["solver"] == "cholmod");
  }
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(Smooth, KeepsToTheMemoryItIsGiven) {
  const TemporaryDirectory directory;
  const std::string in = mesh_with_a_large_factor(directory), out = directory / "out.ply";
  const Words words{"smooth", in, out, "--cutoff", "40"};
  const auto forecast = [&](const Words& more) {
    return figures(words + Words{"--dry-run", "--quiet"} + more)["forecast"];
  };
  const json free = forecast({});
  EXPECT_EQ(free["solver"], "cholmod");
  // Halfway between the two, only one of them fits.
  const double between =
      (free["solvers"][0]["bytes"].get<double>() + free["solvers"][1]["bytes"].get<double>()) / 2;
  const Words limit{"--memory", std::to_string(between)};
  EXPECT_EQ(forecast(limit)["solver"], "cg");

  const RunResult refused = run_program(words + limit + Words{"--solver", "cholmod"});
  EXPECT_EQ(refused.exit_code, 5);
  EXPECT_TRUE(contains(refused.err, "--solver cg fits")) << refused.err;
  const RunResult hopeless = run_program(words + Words{"--memory", "1M"});
  EXPECT_EQ(hopeless.exit_code, 5);
  EXPECT_TRUE(contains(hopeless.err, "the limit is 1 MB")) << hopeless.err;
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(Program, MeshesGoThroughPipesInEveryFormat) {
  for (const std::string format : {"obj", "ply", "off"}) {
    SCOPED_TRACE(format);
    const std::string bytes = made({"torus", "--noise", "0.1"}, format);
    const json found = figures({"info", "-"}, {.input = bytes});
    EXPECT_EQ(found["format"], format);
    EXPECT_EQ(found["genus"], 1);
    const RunResult same = run_program({"smooth", "-", "-", "--steps", "0"}, {.input = bytes});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_EQ(same.out, bytes);
  }
}

TEST(Program, QuietAndVerboseChangeWhatIsSaidNotWhatIsDone) {
  const TemporaryDirectory directory;
  const RunResult quiet = run_program({"make", "cube", directory / "a.off", "--quiet"});
  const RunResult normal = run_program({"make", "cube", directory / "b.off"});
  const RunResult verbose = run_program({"make", "cube", directory / "c.off", "--verbose"});
  EXPECT_EQ(quiet.err, "");
  EXPECT_EQ(normal.err, "");
  EXPECT_TRUE(contains(verbose.err, "8 vertices, 12 faces")) << verbose.err;
  EXPECT_EQ(test::read_bytes(directory / "a.off"), test::read_bytes(directory / "b.off"));
  EXPECT_EQ(test::read_bytes(directory / "a.off"), test::read_bytes(directory / "c.off"));
  EXPECT_NE(run_program({"info", "missing.obj", "--quiet"}).err, "");
}

TEST(Program, ReportFileHoldsWhatJsonPrints) {
  const TemporaryDirectory directory;
  const std::string path = directory / "report.json";
  const RunResult result = run_program({"info", "-", "--json", "--sphere", "--report", path},
                                       {.input = made({"icosphere", "--subdivide", "2"})});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(test::read_bytes(path), result.out);
}

TEST(Make, IsReproducibleAndTheSeedMatters) {
  const Words shape{"icosphere", "--subdivide", "3", "--noise", "0.2"};
  const std::string bytes = made(shape);
  EXPECT_EQ(bytes, made(shape + Words{"--threads", "2"}));
  EXPECT_EQ(bytes, made(shape + Words{"--seed", "1"}));
  EXPECT_NE(bytes, made(shape + Words{"--seed", "2"}));
}

TEST(Make, ScalesAndMoves) {
  const json cube = info_of({"cube", "--scale", "1e-3", "--move", "-1,2.5,1e2"});
  EXPECT_NEAR(cube["area"], 24e-6, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["min"][0], -1.001, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["max"][1], 2.501, 1e-15);
  EXPECT_NEAR(cube["bounding_box"]["max"][2], 100.001, 1e-13);
}

TEST(Make, NoiseHasTheStandardDeviationAskedFor) {
  const TemporaryDirectory directory;
  const Words shape{"icosphere", "--subdivide", "5", "--scale", "7", "--move", "1,2,3"};
  test::write_bytes(directory / "clean.off", made(shape));
  test::write_bytes(directory / "noisy.off", made(shape + Words{"--noise", "0.3"}));
  const json found =
      figures({"compare", directory / "clean.off", directory / "noisy.off", "--samples", "1"});
  const json& distance = found["vertex_distance"];
  // Three coordinates; five standard errors of 30726 normal numbers.
  EXPECT_NEAR(distance["rms"].get<double>() / distance["mean_edge"].get<double>(),
              0.3 * std::sqrt(3.0), 0.3 * std::sqrt(3.0) * 5.0 / std::sqrt(2.0 * 30726));
}

TEST(Info, IcospheresApproachTheSphereAtSecondOrder) {
  double last_area = 0.0;
  double last_energy = 0.0;
  for (int level = 3; level <= 5; ++level) {
    const json found = info_of({"icosphere", "--subdivide", std::to_string(level)});
    const double area = 4.0 * pi - found["area"].get<double>();
    const double energy = 8.0 * pi - found["bending_energy"]["lagrange"].get<double>();
    if (level > 3) {
      EXPECT_NEAR(last_area / area, 4.0, 0.05);
      EXPECT_NEAR(last_energy / energy, 4.0, 0.05);
    }
    last_area = area;
    last_energy = energy;
    EXPECT_NEAR(found["bending_energy"]["crouzeix-raviart"], 8.0 * pi + 0.385, 0.01);
    EXPECT_EQ(found["vertices"], 10 * (1 << (2 * level)) + 2);
    EXPECT_EQ(found["hinges"], found["edges"]);
    EXPECT_EQ(found["genus"], 0);
    EXPECT_EQ(found["closed"], true);
  }
}

TEST(Info, CliffordToriApproachTheirEnergyWhateverTheTriangles) {
  for (const Words& grid : {Words{}, Words{"--straight"}}) {
    double last = 0.0;
    for (const int rows : {16, 32, 64}) {
      const json found = info_of(Words{"torus", "--rows", std::to_string(rows)} + grid);
      EXPECT_EQ(found["genus"], 1);
      const double error = 4.0 * pi * pi - found["bending_energy"]["lagrange"].get<double>();
      if (last != 0.0) {
        EXPECT_NEAR(last / error, 4.0, 0.5);
      }
      last = error;
    }
  }
}

TEST(Info, FlatShapesHaveNoEnergyAndOneBoundary) {
  for (const std::string shape : {"plane", "hexagon"}) {
    const json found = info_of({shape});
    EXPECT_EQ(found["boundary_loops"], 1);
    EXPECT_EQ(found["closed"], false);
    EXPECT_TRUE(found["volume"].is_null());
    for (const auto& [model, energy] : found["bending_energy"].items()) {
      EXPECT_LE(energy.get<double>(), 1e-20) << shape << " " << model;
    }
  }
  EXPECT_EQ(info_of({"cylinder"})["boundary_loops"], 2);
}

TEST(Info, TellsTheEndsOfTheSpectrumOfTheLaplacianThatIsAskedFor) {
  const std::string ball = made({"icosphere", "--subdivide", "3"});
  EXPECT_FALSE(figures({"info", "-"}, {.input = ball}).contains("operator"));
  const json found = figures({"info", "-", "--laplacian", "lagrange", "--mass", "galerkin"},
                             {.input = ball})["operator"];
  EXPECT_EQ(found["laplacian"], "lagrange");
  EXPECT_EQ(found["mass"], "galerkin");
  EXPECT_EQ(found["nodes"], 642);
  EXPECT_EQ(found["zero_eigenvalues"], 1);
  EXPECT_NEAR(found["bending_energy"], 8.0 * pi, 0.1);
  EXPECT_NEAR(found["smallest_eigenvalue"], 2.0, 0.02);  // l (l + 1)
  EXPECT_GT(found["largest_eigenvalue"], 1000);
  const json defaults = figures({"info", "-", "--laplacian", "umbrella"}, {.input = ball});
  EXPECT_EQ(defaults["operator"]["mass"], "valence");
  const RunResult refused =
      run_program({"info", "-", "--laplacian", "umbrella", "--mass", "voronoi"}, {.input = ball});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("barycentric"), std::string::npos);
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

TEST(Info, FitsASphere) {
  const json found = figures(
      {"info", "-", "--sphere"},
      {.input = made({"icosphere", "--subdivide", "3", "--scale", "2", "--move", "5,6,7"})});
  EXPECT_NEAR(found["sphere"]["radius"], 2.0, 1e-13);
  EXPECT_NEAR(found["sphere"]["center"][2], 7.0, 1e-12);
  EXPECT_LE(found["sphere"]["relative_deviation"], 1e-14);
  // The twelve corners of the icosahedron are on the sphere, the middle of its edges is not.
  const json flat =
      figures({"info", "-", "--sphere"}, {.input = made({"icosahedron", "--subdivide", "4"})});
  EXPECT_GT(flat["sphere"]["relative_deviation"], 0.03);
}

TEST(Info, TheTableForPeopleNamesEveryFigure) {
  const RunResult result = run_program({"info", "-", "--sphere"}, {.input = made({"icosphere"})});
  EXPECT_EQ(result.exit_code, 0);
  for (const std::string label :
       {"vertices", "faces", "edges", "components", "genus", "boundary loops", "defects",
        "edge length", "smallest angle", "area", "volume", "bounding box", "E_b crouzeix-raviart",
        "E_b lagrange", "radius deviation"}) {
    EXPECT_TRUE(contains(result.out, "\n" + label + " ")) << label;
  }
}

TEST(Compare, ToleranceDecidesTheExitCode) {
  const TemporaryDirectory directory;
  const std::string a = directory / "a.off";
  const std::string b = directory / "b.ply";
  test::write_bytes(a, made({"plane"}));
  test::write_bytes(b, made({"plane", "--move", "0,0,0.125", "--columns", "11"}, "ply"));
  EXPECT_EQ(run_program({"compare", a, a, "--tolerance", "0", "--samples", "999"}).exit_code, 0);
  EXPECT_EQ(run_program({"compare", a, b, "--tolerance", "0.1251", "--samples", "999"}).exit_code,
            0);
  EXPECT_EQ(run_program({"compare", a, b, "--tolerance", "0.1249", "--samples", "999"}).exit_code,
            1);
  const json found = figures({"compare", a, b, "--samples", "999"});
  EXPECT_EQ(found["same_connectivity"], false);
  EXPECT_NEAR(found["surface_distance"]["a_to_b"]["max"], 0.125, 1e-15);
  EXPECT_NEAR(found["surface_distance"]["b_to_a"]["rms"], 0.125, 1e-15);
  EXPECT_NEAR(found["area_ratio"], 1.0, 1e-12);
}

TEST(Compare, MeasuresAgainstExactSurfaces) {
  const json torus = figures({"compare", "-", "--torus", "1,0.4"},
                             {.input = made({"torus", "--ratio", "2.5", "--rows", "32"})});
  EXPECT_LE(torus["exact_surface"]["vertex_distance"]["max"], 1e-15);
  EXPECT_EQ(torus["exact_surface"]["triangle_normal_degrees"]["flipped"], 0);

  const std::string sphere = made({"icosphere", "--subdivide", "3", "--move", "1,0,0"});
  const Words against{"compare", "-", "--sphere"};
  EXPECT_LE(figures(against + Words{"1", "--center", "1,0,0"},
                    {.input = sphere})["exact_surface"]["vertex_distance"]["max"],
            1e-15);
  EXPECT_NEAR(
      figures(against + Words{"1"}, {.input = sphere})["exact_surface"]["vertex_distance"]["max"],
      1.0, 1e-12);
  EXPECT_LE(figures(against + Words{"fit"}, {.input = sphere})["radius_deviation"], 1e-14);
  EXPECT_EQ(run_program(against + Words{"0.5", "--center", "1,0,0", "--tolerance", "0.4"},
                        {.input = sphere})
                .exit_code,
            1);
}

TEST(Compare, DoesNotDependOnTheNumberOfThreads) {
  const TemporaryDirectory directory;
  test::write_bytes(directory / "a.off", made({"torus", "--noise", "0.2"}));
  test::write_bytes(directory / "b.off", made({"torus", "--noise", "0.1", "--straight"}));
  const Words both{"compare", directory / "a.off", directory / "b.off", "--json", "--samples",
                   "3000",    "--threads"};
  const RunResult one = run_program(both + Words{"1"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, run_program(both + Words{"2"}).out);
}

}  // namespace
}  // namespace ibmfair
