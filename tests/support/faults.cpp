#include "support/faults.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"

namespace ibmfair::test {

namespace fs = std::filesystem;

namespace {

std::string old_bytes(const std::string& target) {
  return "what " + target + " held before\n";
}

bool is_temporary(const std::string& name) {
  const std::string last = fs::path(name).filename().string();
  return last.starts_with(".ibmfair-") && last.ends_with(".tmp");
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      names.insert(entry.path().lexically_relative(folder).string());
    }
  }
  return names;
}

}  // namespace

bool faults_can_be_injected() {
#ifdef IBMFAIR_SANITIZED
  return false;
#else
  return true;
#endif
}

std::vector<std::string> environment_of(const Fault& fault) {
  std::vector<std::string> variables{
      std::string("LD_PRELOAD=") + IBMFAIR_FAULTS,
      "FAULT_CALL=" + fault.call,
      "FAULT_FIRST=" + std::to_string(fault.first),
      "FAULT_LAST=" + std::to_string(fault.last),
      "FAULT_ERROR=" + std::to_string(fault.error),
      "FAULT_SIGNAL=" + std::to_string(fault.signal_number),
      std::string("FAULT_NO_UNNAMED_FILES=") + (fault.no_unnamed_files ? "1" : "0")};
  if (!fault.truncated.empty()) {
    variables.push_back("FAULT_TRUNCATED=" + fault.truncated);
  }
  return variables;
}

long count_calls(const Fault& fault, const Words& words, RunOptions options) {
  const TemporaryDirectory directory;
  options.environment = environment_of(fault);
  options.environment.push_back("FAULT_COUNT=" + (directory / "count"));
  EXPECT_EQ(run_program(words, options).exit_code, 0) << words.front();
  return std::stol(read_bytes(directory / "count"));
}

WritingRun::WritingRun(Words words, const std::vector<std::string>& targets)
    : words_(std::move(words)) {
  const auto make = [this](const Words& shape) {
    const RunResult made = run_program(Words{"make"} + shape, {.directory = folder()});
    EXPECT_EQ(made.exit_code, 0) << made.err;
  };
  make({"icosphere", "in.ply", "--subdivide", "2", "--noise", "0.1"});
  make({"cylinder", "holed.off", "--rows", "6"});
  for (const std::string& name : files_in(folder())) {
    inputs_[name] = read_bytes(directory_ / name);
  }
  for (const std::string& target : targets) {
    whole_[target];
  }
  EXPECT_EQ(run().exit_code, 0);
  for (auto& [target, bytes] : whole_) {
    bytes = read_bytes(directory_ / target);
    EXPECT_NE(bytes, old_bytes(target));
  }
}

bool WritingRun::is_batch() const {
  return std::find(words_.begin(), words_.end(), "--out-dir") != words_.end();
}

RunResult WritingRun::run(RunOptions options) {
  for (const std::string& name : files_in(folder())) {
    if (!inputs_.contains(name)) {
      fs::remove(directory_ / name);
    }
  }
  for (const auto& [target, bytes] : whole_) {
    fs::create_directories(fs::path(directory_ / target).parent_path());
    write_bytes(directory_ / target, old_bytes(target));
  }
  options.directory = folder();
  return run_program(words_, options);
}

/// The HTML reports contain times, so that their bytes differ from run to run.
bool WritingRun::is_whole(const std::string& target, const std::string& bytes) const {
  if (target.ends_with(".html")) {
    return bytes.size() + 1000 > whole_.at(target).size() && contains(bytes, "</html>");
  }
  return target.ends_with(".json") ? nlohmann::json::accept(bytes) && bytes.ends_with("}\n")
                                   : bytes == whole_.at(target);
}

void WritingRun::expect_promises(const RunResult& result) const {
  for (const auto& [name, bytes] : inputs_) {
    EXPECT_EQ(read_bytes(directory_ / name), bytes) << name;
  }
  for (const auto& [target, whole] : whole_) {
    const std::string bytes = read_bytes(directory_ / target);
    EXPECT_TRUE(is_whole(target, bytes) || (result.exit_code != 0 && bytes == old_bytes(target)))
        << target << " holds " << bytes.size() << " bytes, exit code " << result.exit_code << "\n"
        << result.err;
  }
  for (const std::string& name : files_in(folder())) {
    EXPECT_TRUE(inputs_.contains(name) || whole_.contains(name) || name.ends_with(".journal") ||
                is_temporary(name))
        << name;
  }
  if (result.exit_code > 0) {
    EXPECT_TRUE(contains(result.err, "ibmfair: ")) << result.exit_code << result.err;
  }
}

std::size_t WritingRun::count_temporary_files() const {
  const std::set<std::string> names = files_in(folder());
  return static_cast<std::size_t>(std::count_if(names.begin(), names.end(), is_temporary));
}

std::vector<std::unique_ptr<WritingRun>> writing_runs() {
  std::vector<std::unique_ptr<WritingRun>> runs;
  const auto add = [&runs](const Words& words, const std::vector<std::string>& targets) {
    runs.push_back(
        std::make_unique<WritingRun>(words + Words{"--overwrite", "--threads", "1"}, targets));
  };
  add({"smooth", "in.ply", "out.ply", "--steps", "2"}, {"out.ply"});
  add({"smooth", "in.ply", "out.obj", "--steps", "1", "--report", "report.json"},
      {"out.obj", "report.json"});
  add({"fill", "holed.off", "out.off", "--all"}, {"out.off"});
  add({"make", "torus", "out.ply", "--rows", "8"}, {"out.ply"});
  add({"info", "in.ply", "--report", "report.json"}, {"report.json"});
  add({"smooth", "in.ply", "--out-dir", "out", "--steps", "1", "--summary", "summary.json"},
      {"out/in.ply", "summary.json"});
  if (writes_pages()) {
    add({"fill", "holed.off", "out.off", "--all", "--report", "page.html"},
        {"out.off", "page.html"});
  }
  return runs;
}

}  // namespace ibmfair::test
