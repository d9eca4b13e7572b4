// The program on odd and hostile files that others collected: each run ends as the table of
// outcomes says, soon, and without taking much memory.
#include "support/malformed_outcomes.h"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

/// If this variable is set, the test writes a new table; a person then has to judge the changes.
constexpr const char* record_variable = "IBMFAIR_RECORD_OUTCOMES";

TEST(MalformedOutcomes, AreThoseOfTheTable) {
  const std::vector<std::string> paths = shared_meshes("malformed");
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  Outcomes found;
  for (const std::string& path : paths) {
    const std::filesystem::path full(path);
    found[full.parent_path().filename() / full.filename()] = outcomes_of(path);
  }
  if (std::getenv(record_variable) != nullptr) {
    write_bytes(outcomes_path(), outcomes_text(found));
  }
  const Outcomes expected = expected_outcomes();
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, by_command] : found) {
    for (const auto& [command, outcome] : by_command) {
      SCOPED_TRACE(testing::Message() << command << " " << name);
      const auto row = expected.find(name);
      ASSERT_NE(row, expected.end());
      EXPECT_EQ(outcome.exit_code, row->second.at(command).exit_code) << outcome.message;
      EXPECT_EQ(outcome.message, row->second.at(command).message);
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
