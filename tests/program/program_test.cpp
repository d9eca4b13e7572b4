// The real program, run as its users run it.
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::contains;
using test::figures;
using test::made;
using test::run_program;
using test::RunResult;
using test::runs_in_emulator;
using test::StandardOutput;
using test::TemporaryDirectory;
using test::Words;
using test::operator+;

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
  for (const std::string part : {"ibmfair ", "Eigen ", "AMD ", "kernels "}) {
    EXPECT_TRUE(contains(version.out, part)) << version.out;
  }
}

struct Misuse {
  Words arguments;
  std::string message;  // a part of the message
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
  EXPECT_TRUE(contains(strict.err, "1 edge of three or more triangles")) << strict.err;
  EXPECT_EQ(strict.out, lenient.out);  // --strict prints the figures, too

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
  if (runs_in_emulator()) GTEST_SKIP() << "the emulator needs more address space than that";
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  if (!std::filesystem::exists("/usr/bin/prlimit")) {
    GTEST_SKIP() << "no prlimit";
  }
  const RunResult result =
      run_program({"make", "icosphere", "-", "--format", "off", "--subdivide", "9"},
                  {.address_space = std::int64_t{3} << 26U});
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(contains(result.err, "memory")) << result.err;
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

}  // namespace
}  // namespace ibmfair
