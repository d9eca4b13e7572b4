// The same input gives the same bytes in every run, for any number of threads, and on every
// processor with AVX2 and FMA, or on every processor without them. Between these two kinds of
// processors, energies, factors and some functions of the C library are rounded differently:
// results agree to many digits only, and only if no triangle is about to fold.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "support/files.h"
#include "support/kernel_sets.h"
#include "support/mesh_io.h"
#include "support/run_program.h"
#include "support/shell.h"
#include "support/solvers.h"

namespace ibmfair::test {
namespace {

/// A noisy torus and a mesh with holes, so large that all loops are shared between threads.
class DeterminismTest : public testing::Test {
 protected:
  DeterminismTest() {
    make({"torus", whole_, "--rows", "60", "--columns", "150", "--noise", "0.2"});
    make({"cylinder", open_, "--rows", "60", "--columns", "90", "--noise", "0.02"});
  }

  static void make(const Words& words) {
    const RunResult result = run_program(Words{"make"} + words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }

  std::string result_of(const Words& words, const std::vector<std::string>& environment = {},
                        const std::vector<std::string>& launcher = {}) {
    const RunResult result = run_program(words + Words{out_, "--overwrite", "--quiet"},
                                         {.environment = environment, .launcher = launcher});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_bytes(out_);
  }

  /// Every way to compute: both energies, these solvers, and holes.
  std::vector<Words> runs(const std::vector<std::string>& solvers) const {
    std::vector<Words> all{{"fill", open_, "--all"}};
    for (const std::string energy : {"crouzeix-raviart", "lagrange"}) {
      for (const std::string& solver : solvers) {
        all.push_back(
            {"smooth", whole_, "--steps", "4", "--laplacian", energy, "--solver", solver});
      }
    }
    return all;
  }

  TemporaryDirectory directory_;
  const std::string whole_ = directory_ / "whole.ply";
  const std::string open_ = directory_ / "open.ply";
  const std::string out_ = directory_ / "out.ply";
};

std::string text_of(const Words& words) {
  std::string text;
  for (const std::string& word : words) {
    text += word + " ";
  }
  return text;
}

TEST_F(DeterminismTest, TwentyRunsOnOneAndTwoThreadsGiveTheSameBytes) {
  for (const Words& words : runs(solvers())) {
    SCOPED_TRACE(text_of(words));
    const std::string bytes = result_of(words + Words{"--threads", "1"});
    for (int run = 1; run < 20; ++run) {
      ASSERT_TRUE(result_of(words + Words{"--threads", run % 2 == 0 ? "1" : "2"}) == bytes) << run;
    }
  }
}

/// Selects the C library's functions (such as atan2 and exp) for processors without FMA; their last
/// digit differs in one of many results.
const std::string plain_c_library = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX";

/// The command that starts the program on a processor that qemu emulates; nothing if qemu is not
/// installed.
std::optional<std::vector<std::string>> emulating([[maybe_unused]] const std::string& processor) {
#ifdef __x86_64__
  if (is_installed("qemu-x86_64")) {
    return std::vector<std::string>{"/usr/bin/env", "qemu-x86_64", "-cpu", processor};
  }
#endif
  return std::nullopt;
}

struct Processor {
  std::string name, kernels;
};

// Two of the emulated processors have neither AVX2 nor FMA, and one has both, whatever processor
// this machine has.
TEST_F(DeterminismTest, EmulatedProcessorsRunTheirKernelsWithTheBytesOfThisOne) {
  make({"torus", whole_, "--rows", "20", "--columns", "50", "--noise", "0.2", "--overwrite"});
  make({"cylinder", open_, "--rows", "20", "--columns", "30", "--noise", "0.02", "--overwrite"});
  for (const Processor& processor : std::vector<Processor>{
           {"core2duo", "baseline"}, {"Nehalem", "baseline"}, {"Haswell", "avx2"}}) {
    SCOPED_TRACE(processor.name);
    const auto launcher = emulating(processor.name);
    if (!launcher) GTEST_SKIP() << "no qemu-x86_64";
    const RunResult version = run_program({"--version"}, {.launcher = *launcher});
    EXPECT_TRUE(contains(version.out, "kernels " + processor.kernels)) << version.out;
    if (processor.kernels == "avx2") SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
    // The BLAS of CHOLMOD chooses other kernels on other processors.
    for (const Words& words : runs({"multifrontal", "cg"})) {
      SCOPED_TRACE(text_of(words));
      std::vector<std::string> environment{"IBMFAIR_KERNELS=" + processor.kernels};
      if (processor.kernels == "baseline") environment.push_back(plain_c_library);
      const std::string here = result_of(words, environment);
      EXPECT_TRUE(result_of(words, {}, *launcher) == here);
    }
  }
}

TEST_F(DeterminismTest, ASetOfKernelsThatTheProcessorLacksIsRefused) {
  const auto launcher = emulating("Nehalem");
  if (!launcher) GTEST_SKIP() << "no qemu-x86_64";
  const RunResult result = run_program(
      {"info", whole_}, {.environment = {"IBMFAIR_KERNELS=avx2"}, .launcher = *launcher});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(
      contains(result.err, "IBMFAIR_KERNELS: this processor cannot run the kernels for avx2"))
      << result.err;
}

TEST_F(DeterminismTest, ASetOfKernelsThatThereIsNotIsRefused) {
  const RunResult result = run_program({"info", whole_}, {.environment = {"IBMFAIR_KERNELS=mmx"}});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "IBMFAIR_KERNELS: 'mmx' is neither baseline nor avx2"))
      << result.err;
}

TEST_F(DeterminismTest, WithoutFmaManyDigitsAgreeWhereNothingFolds) {
  SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
  struct Without {
    std::vector<std::string> environment;
    double difference;  // relative to the size
  };
  const std::vector<Without> all{{{plain_c_library}, 1e-12},
                                 {{plain_c_library, "IBMFAIR_KERNELS=baseline"}, 1e-6}};
  make({"torus", whole_, "--rows", "60", "--columns", "150", "--noise", "0.01", "--overwrite"});
  for (const Words& words : runs(solvers())) {
    SCOPED_TRACE(text_of(words));
    const Points X = MeshFiles::read(result_of(words), "here.ply").mesh().X;
    for (const auto& [environment, difference] : all) {
      const std::string there = result_of(words, environment);
      const Points Y = MeshFiles::read(there, "there.ply").mesh().X;
      ASSERT_EQ(Y.rows(), X.rows());
      EXPECT_LE((Y - X).cwiseAbs().maxCoeff(), difference * bounding_box_size(X).norm());
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
