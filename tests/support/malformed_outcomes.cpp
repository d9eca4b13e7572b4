#include "support/malformed_outcomes.h"

#include <sstream>

#include <fmt/format.h>

#include "support/files.h"

namespace ibmfair::test {

namespace {

constexpr const char* table_header = "file\tcommands\texit code\tmessage\n";

std::string field(std::istringstream& line) {
  std::string text;
  std::getline(line, text, '\t');
  return text;
}

}  // namespace

const std::vector<std::string>& outcome_commands() {
  static const std::vector<std::string> commands{"info", "smooth", "fill"};
  return commands;
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
