#include "support/malformed_outcomes.h"

#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/files.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {

namespace {

constexpr const char* table_header = "file\tcommands\texit code\tmessage\n";

std::string field(std::istringstream& line) {
  std::string text;
  std::getline(line, text, '\t');
  return text;
}

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

Outcome outcome_of(const std::string& command, const std::string& path, const Words& options) {
  const TemporaryDirectory directory;
  Words words{command, path};
  const bool writes = command != "info";
  if (writes) words = words + Words{directory / "out.ply", "--overwrite"} + options;
  const RunResult result = run_program(words);
  Outcome outcome{result.exit_code, error_text(result, path)};
  EXPECT_TRUE(outcome.message.empty() || result.err.find(path) != std::string::npos) << result.err;
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

}  // namespace

const std::vector<std::string>& outcome_commands() {
  static const std::vector<std::string> commands{"info", "smooth", "fill"};
  return commands;
}

CommandOutcomes outcomes_of(const std::string& path, const Words& smooth_options) {
  CommandOutcomes outcomes;
  for (const std::string& command : outcome_commands()) {
    SCOPED_TRACE(testing::Message() << command << " " << path);
    outcomes[command] = outcome_of(command, path, command == "smooth" ? smooth_options : Words());
  }
  return outcomes;
}

std::string outcomes_path() {
  return project_file("tests/malformed_outcomes.tsv");
}

Outcomes expected_outcomes() {
  Outcomes outcomes;
  std::istringstream table(read_bytes(outcomes_path()));
  std::string text;
  std::getline(table, text);  // the header
  while (std::getline(table, text)) {
    std::istringstream line(text);
    const std::string file = field(line);
    std::istringstream commands(field(line));
    Outcome outcome;
    outcome.exit_code = std::stoi(field(line));
    outcome.message = field(line);
    for (std::string command; commands >> command;) {
      outcomes[file][command] = outcome;
    }
  }
  return outcomes;
}

std::string outcomes_text(const Outcomes& outcomes) {
  std::string text = table_header;
  for (const auto& [file, by_command] : outcomes) {
    std::vector<std::pair<std::string, Outcome>> lines;
    for (const std::string& command : outcome_commands()) {
      const Outcome& outcome = by_command.at(command);
      if (!lines.empty() && lines.back().second == outcome) {
        lines.back().first += " " + command;
      } else {
        lines.emplace_back(command, outcome);
      }
    }
    for (const auto& [commands, outcome] : lines) {
      text += fmt::format("{}\t{}\t{}{}{}\n", file, commands, outcome.exit_code,
                          outcome.message.empty() ? "" : "\t", outcome.message);
    }
  }
  return text;
}

}  // namespace ibmfair::test
