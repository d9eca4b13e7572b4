// `--precision keep|float|double` on the command line: smooth, fill, make and many files.
#include <string>

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

class PrecisionOption : public testing::Test {
 protected:
  /// Runs the program; it must succeed.
  std::string run(const Words& words) const {
    const RunResult result = run_program(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }

  void make(const std::string& name, const std::string& type, const Words& more = {}) const {
    run(Words{"make", "torus", path(name), "--precision", type, "--noise", "0.1"} + more);
  }

  std::string path(const std::string& name) const { return directory_ / name; }

  /// The type of the coordinates that the PLY file declares.
  std::string type_in(const std::string& name) const {
    const std::string bytes = read_bytes(path(name));
    const std::string start = "property ";
    const std::size_t at = bytes.find(start) + start.size();
    return bytes.substr(at, bytes.find(' ', at) - at);
  }

  TemporaryDirectory directory_;
};

TEST_F(PrecisionOption, KeepsTheTypeOfTheInput) {
  for (const std::string type : {"float", "double"}) {
    SCOPED_TRACE(type);
    make("in.ply", type, {"--overwrite"});
    EXPECT_EQ(type_in("in.ply"), type);
    EXPECT_FALSE(
        contains(run({"smooth", path("in.ply"), path("out.ply"), "--overwrite"}), "declared"));
    EXPECT_EQ(type_in("out.ply"), type);
  }
}

TEST_F(PrecisionOption, ConvertsBothWays) {
  make("float.ply", "float");
  make("double.ply", "double");
  EXPECT_TRUE(contains(run({"smooth", path("float.ply"), path("a.ply"), "--precision", "double"}),
                       "declared double"));
  EXPECT_EQ(type_in("a.ply"), "double");
  EXPECT_TRUE(contains(run({"smooth", path("double.ply"), path("b.ply"), "--precision", "float"}),
                       "rounded to float32"));
  EXPECT_EQ(type_in("b.ply"), "float");
}

TEST_F(PrecisionOption, NamesTheCostFarFromTheOrigin) {
  make("far.ply", "float", {"--move", "1e5,0,0"});
  EXPECT_TRUE(contains(run({"smooth", path("far.ply"), path("a.ply")}), "--precision float"));
  EXPECT_EQ(type_in("a.ply"), "double");
  EXPECT_TRUE(contains(run({"smooth", path("far.ply"), path("b.ply"), "--precision", "float"}),
                       "float32 rounds the coordinates by"));
  EXPECT_EQ(type_in("b.ply"), "float");
}

TEST_F(PrecisionOption, HoldsForPatches) {
  run({"make", "cylinder", path("in.ply"), "--precision", "float"});
  run({"fill", path("in.ply"), path("out.ply"), "--all"});
  EXPECT_EQ(type_in("out.ply"), "float");
  run({"fill", path("in.ply"), path("exact.ply"), "--all", "--precision", "double"});
  EXPECT_EQ(type_in("exact.ply"), "double");
}

TEST_F(PrecisionOption, HoldsForManyFiles) {
  make("a.ply", "double");
  make("b.ply", "double", {"--seed", "2"});
  run({"smooth", path("a.ply"), path("b.ply"), "--out-dir", path("out"), "--precision", "float"});
  EXPECT_EQ(type_in("out/a.ply"), "float");
  EXPECT_EQ(type_in("out/b.ply"), "float");
}

TEST_F(PrecisionOption, RefusesOtherWordsAndNamesThese) {
  const RunResult result = run_program({"make", "torus", path("a.ply"), "--precision", "single"});
  EXPECT_EQ(result.exit_code, 2);
  for (const std::string word : {"--precision", "keep", "float", "double"}) {
    EXPECT_TRUE(contains(result.err, word)) << result.err;
  }
}

}  // namespace
}  // namespace ibmfair::test
