// The same input gives the same bytes: run after run, for any number of threads, and for whatever
// instructions our kernels and the C library use. Only without FMA energies and factors are rounded
// differently: results agree to many digits only then, and only where no triangle is about to fold.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "support/files.h"
#include "support/mesh_io.h"
#include "support/run_program.h"

namespace ibmfair::test {
namespace {

/// A noisy torus and a holed one, large enough that all loops are shared between threads.
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

  std::string result_of(const Words& words, const std::vector<std::string>& environment = {}) {
    const RunResult result =
        run_program(words + Words{out_, "--overwrite", "--quiet"}, {.environment = environment});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_bytes(out_);
  }

  /// Every way to compute: both energies, both solvers, and holes.
  std::vector<Words> runs() const {
    std::vector<Words> all{{"fill", open_, "--all"}};
    for (const std::string energy : {"crouzeix-raviart", "lagrange"}) {
      for (const std::string solver : {"cholmod", "cg"}) {
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
  for (const Words& words : runs()) {
    SCOPED_TRACE(text_of(words));
    const std::string bytes = result_of(words + Words{"--threads", "1"});
    for (int run = 1; run < 20; ++run) {
      ASSERT_EQ(result_of(words + Words{"--threads", run % 2 == 0 ? "1" : "2"}), bytes) << run;
    }
  }
}

const std::string plain_c_library = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX";

TEST_F(DeterminismTest, InstructionSetsOfOursAndTheCLibrarysChangeNoByte) {
  for (const Words& words : runs()) {
    SCOPED_TRACE(text_of(words));
    const std::string here = result_of(words);
    EXPECT_EQ(result_of(words, {plain_c_library}), here);
    EXPECT_EQ(result_of(words, {plain_c_library, "IBMFAIR_KERNELS=avx2"}), here);
  }
  EXPECT_EQ(run_program({"info", whole_}, {.environment = {"IBMFAIR_KERNELS=mmx"}}).exit_code, 2);
}

TEST_F(DeterminismTest, WithoutFmaManyDigitsAgreeWhereNothingFolds) {
  make({"torus", whole_, "--rows", "60", "--columns", "150", "--noise", "0.01", "--overwrite"});
  for (const Words& words : runs()) {
    SCOPED_TRACE(text_of(words));
    const Points X = MeshFiles::read(result_of(words), "here.ply").mesh().X;
    const std::string there = result_of(words, {plain_c_library, "IBMFAIR_KERNELS=baseline"});
    const Points Y = MeshFiles::read(there, "there.ply").mesh().X;
    ASSERT_EQ(Y.rows(), X.rows());
    EXPECT_LE((Y - X).cwiseAbs().maxCoeff(), 1e-6 * bounding_box_size(X).norm());
  }
}

}  // namespace
}  // namespace ibmfair::test
