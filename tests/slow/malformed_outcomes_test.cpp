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

/// The largest processor time, relative to the time for closing a cylinder with 20,000 new
/// vertices, which is work of the same kind: the slowest file takes 4 times as much. Times below
/// `few_seconds` are not compared.
constexpr double most_cylinders = 15;
constexpr double few_seconds = 1;
constexpr double most_megabytes = 1000;

/// The text of the first error, without the names of the program and the file.
std::string error_text(const RunResult& result, const std::string& path) {
  const std::string start = "ibmfair: error: ";
  const std::size_t at = result.err.find(start);
  if (at == std::string::npos) return {};
  std::string text = result.err.substr(at + start.size());
  text.resize(text.find('\n'));
  if (text.starts_with(path + ":")) text.erase(0, path.size() + 1);
  return text.starts_with(" ") ? text.substr(1) : text;
}

double cylinder_seconds() {
  const TemporaryDirectory directory;
  const std::string cylinder = directory / "cylinder.ply";
  run_program({"make", "cylinder", cylinder, "--columns", "240"});
  return run_program({"fill", cylinder, directory / "out.ply", "--all"}).cpu_seconds;
}

/// Whether the command, which has taken this many seconds, stays within its time limit. It has
/// three attempts, because other programs on the machine come and go.
[[maybe_unused]] bool ends_soon(double seconds, const Words& words) {
  for (int turn = 1; seconds > few_seconds && seconds > most_cylinders * cylinder_seconds();
       ++turn) {
    if (turn == 3) return false;
    seconds = run_program(words).cpu_seconds;
  }
  return true;
}

Outcome outcome_of(const std::string& command, const std::string& path) {
  const TemporaryDirectory directory;
  Words words{command, path};
  const bool writes = command != "info";
  if (writes) words = words + Words{directory / "out.ply", "--overwrite"};
  const RunResult result = run_program(words);
  Outcome outcome{result.exit_code, error_text(result, path)};
  // An output file is complete; after an error there is no output file.
  const bool written = std::filesystem::exists(directory / "out.ply");
  EXPECT_EQ(written, writes && outcome.message.empty());
  if (written) {
    EXPECT_EQ(run_program({"info", directory / "out.ply"}).exit_code, 0);
  }
  EXPECT_EQ(directory.entries(), written ? 1U : 0U);
#ifndef IBMFAIR_SANITIZED
  EXPECT_TRUE(ends_soon(result.cpu_seconds, words)) << result.cpu_seconds << " s";
  EXPECT_LE(result.peak_megabytes, most_megabytes);
#endif
  return outcome;
}

TEST(MalformedOutcomes, AreThoseOfTheTable) {
  const std::vector<std::string> paths = shared_meshes("malformed");
  if (paths.empty()) GTEST_SKIP() << "no ../shared/meshes";
  Outcomes found;
  for (const std::string& path : paths) {
    const std::filesystem::path full(path);
    const std::string name = full.parent_path().filename() / full.filename();
    for (const std::string& command : outcome_commands()) {
      SCOPED_TRACE(testing::Message() << command << " " << name);
      found[name][command] = outcome_of(command, path);
    }
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
