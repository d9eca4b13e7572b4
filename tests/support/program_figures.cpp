#include "support/program_figures.h"

#include <gtest/gtest.h>

namespace ibmfair::test {

using nlohmann::json;

json figures(const Words& arguments, const RunOptions& options) {
  const RunResult result = run_program(arguments + Words{"--json"}, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  json parsed = json::parse(result.out, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << result.out;
  EXPECT_EQ(parsed.value("version", 0), 1);
  return parsed;
}

std::string made(const Words& arguments, const std::string& format) {
  const RunResult result = run_program(Words{"make"} + arguments + Words{"-", "--format", format});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

json info_of(const Words& shape) {
  return figures({"info", "-"}, {.input = made(shape)});
}

}  // namespace ibmfair::test
