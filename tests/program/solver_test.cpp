// `smooth --solver`: each solver is what its name says, and CHOLMOD is loaded only where it is
// used.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/solvers.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

class Solvers : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"make", "torus", in_, "--noise", "0.2"}).exit_code, 0);
  }

  Words smooth(const Words& more) const {
    return Words{"smooth", in_, out_, "--overwrite", "--quiet", "--steps", "4"} + more;
  }

  json figures_of(const Words& more) const { return figures(smooth(more)); }

  /// Whether the run opened a library whose name contains `part`, as the dynamic linker tells.
  bool loads(const Words& words, const std::string& part) const {
    const RunResult run = run_program(words, {.environment = {"LD_DEBUG=files"}});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(contains(run.err, "libtbb")) << "the linker does not tell what it loads";
    return contains(run.err, part);
  }

  static std::string components_of(const json& report) {
    std::string names;
    for (const json& component : report["components"]) {
      names += component["name"].get<std::string>() + " ";
    }
    return names;
  }

  TemporaryDirectory directory_;
  const std::string in_ = directory_ / "in.ply", out_ = directory_ / "out.ply";
};

TEST_F(Solvers, ThePublishedSchemeIsOneFactorizationByCholmod) {
  if (!has_cholmod()) GTEST_SKIP() << "CHOLMOD was not built in, or is not installed";
  const json report = figures_of({"--plain"});
  EXPECT_EQ(report["flow"]["solver"], "cholmod");
  EXPECT_EQ(report["flow"]["factorizations"], 1);
  EXPECT_EQ(report["flow"]["solves"], 4);
  EXPECT_GT(report["flow"]["factor_entries"], 0);
  EXPECT_TRUE(contains(components_of(report), "CHOLMOD BLAS")) << components_of(report);
}

TEST_F(Solvers, OthersThanCholmodLoadNeitherItNorABlas) {
  if (!has_cholmod()) GTEST_SKIP() << "CHOLMOD was not built in, or is not installed";
  if (runs_in_emulator()) GTEST_SKIP() << "the emulator has a linker of its own";
  EXPECT_TRUE(loads(smooth({"--solver", "cholmod"}), "libcholmod"));
  EXPECT_TRUE(loads(smooth({"--solver", "cholmod"}), "blas"));
  EXPECT_TRUE(loads({"--version", "-v"}, "libcholmod"));
  for (const Words& words :
       {smooth({}), smooth({"--solver", "multifrontal"}), smooth({"--solver", "cg"}),
        smooth({"--plain", "--solver", "multifrontal"}), Words{"--version"}}) {
    EXPECT_FALSE(loads(words, "libcholmod")) << words.back();
    EXPECT_FALSE(loads(words, "blas")) << words.back();
  }
  const json report = figures_of({"--solver", "multifrontal"});
  EXPECT_FALSE(contains(components_of(report), "CHOLMOD")) << components_of(report);
}

TEST_F(Solvers, TheVersionNamesTheBlasWhereDetailsAreAskedFor) {
  if (!has_cholmod()) GTEST_SKIP() << "CHOLMOD was not built in, or is not installed";
  const RunResult details = run_program({"--version", "-v"});
  EXPECT_EQ(details.exit_code, 0);
  EXPECT_TRUE(contains(details.out, "\n  CHOLMOD ")) << details.out;
  EXPECT_TRUE(contains(details.out, "\n  BLAS ")) << details.out;
  EXPECT_FALSE(contains(run_program({"--version"}).out, "BLAS"));
}

TEST_F(Solvers, ACholmodThatCannotBeLoadedIsNamedWithTheSolverThatReplacesIt) {
  if (!has_cholmod()) GTEST_SKIP() << "CHOLMOD was not built in, or is not installed";
  // A file that is no library, where the linker looks first.
  const std::string folder = directory_ / "broken";
  std::filesystem::create_directory(folder);
  for (const char* name : {"libcholmod.so.3", "libcholmod.so.4", "libcholmod.so.5"}) {
    write_bytes(folder + "/" + name, "not a library");
  }
  const RunOptions broken{.environment = {"LD_LIBRARY_PATH=" + folder}};
  const RunResult refused = run_program(smooth({"--solver", "cholmod"}), broken);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "CHOLMOD cannot be loaded") &&
              contains(refused.err, "multifrontal"))
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_TRUE(contains(run_program({"--version", "-v"}, broken).out, "cannot be loaded"));

  // The published scheme does not depend on the package.
  const RunResult plain = run_program(smooth({"--plain", "--report", "-"}), broken);
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(json::parse(plain.out)["flow"]["solver"], "multifrontal");
}

}  // namespace
}  // namespace ibmfair::test
