// The program on odd, broken and hostile files: each command ends with the exit code and the
// message that the table of these files gives, soon, and without taking much memory.
#include "support/malformed_files.h"

#include <gtest/gtest.h>

#include "support/files.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

class MalformedPrograms : public testing::TestWithParam<const char*> {};

/// A cut-off of half an edge leaves small bodies their shape, so that no flow stalls.
const Words gentle{"--cutoff", "0.5"};

TEST_P(MalformedPrograms, EndAsTheTableSays) {
  const TemporaryDirectory directory;
  for (const MalformedFile& file : malformed_files(GetParam())) {
    SCOPED_TRACE(file.name);
    write_bytes(directory / file.name, file.bytes);
    for (const auto& [command, outcome] : outcomes_of(directory / file.name, gentle)) {
      SCOPED_TRACE(command);
      EXPECT_EQ(outcome.exit_code, file.outcomes.at(command).exit_code);
      EXPECT_EQ(outcome.message, file.outcomes.at(command).message);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MalformedPrograms, testing::Values("obj", "off", "ply", "stl"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace ibmfair::test
