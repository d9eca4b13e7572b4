#include "support/batch_files.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "support/files.h"

namespace ibmfair::test {

namespace fs = std::filesystem;
using nlohmann::json;

BatchTest::BatchTest() {
  fs::create_directory(full("in"));
  for (const std::string name : {"a", "b", "c"}) {
    inputs_.push_back(path(name));
    make(name, static_cast<int>(inputs_.size()));
  }
}

bool BatchTest::exists(const std::string& name) const {
  return fs::exists(full(name));
}

std::string BatchTest::bytes(const std::string& name) const {
  return read_bytes(full(name));
}

RunResult BatchTest::run(const Words& arguments, RunOptions options) const {
  options.directory = directory_.path().string();
  return run_program(arguments, options);
}

void BatchTest::make(const std::string& name, int seed, int subdivide) const {
  const RunResult result =
      run({"make", "icosphere", path(name), "--noise", "0.1", "--overwrite", "--seed",
           std::to_string(seed), "--subdivide", std::to_string(subdivide)});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

std::string BatchTest::single(const std::string& input, const Words& options) const {
  const RunResult result = run(Words{"smooth", input, "-", "--format", "off"} + options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.out;
}

Statuses BatchTest::statuses(const Words& arguments, int exit_code) const {
  const RunResult result = run(arguments + Words{"--json"});
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  Statuses found;
  const json summary = json::parse(result.out, nullptr, false);
  if (!summary.is_object()) {
    ADD_FAILURE() << "no summary: " << result.out << result.err;
    return found;
  }
  for (const json& item : summary.at("items")) {
    const std::string input = item.at("input");
    found[input.empty() ? item.at("output").get<std::string>() : input] = item.at("status");
  }
  return found;
}

std::size_t BatchTest::count(const std::string& folder, const std::string& extension) const {
  std::size_t found = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(full(folder), error)) {
    found += entry.path().extension() == extension ? 1 : 0;
  }
  return found;
}

}  // namespace ibmfair::test
