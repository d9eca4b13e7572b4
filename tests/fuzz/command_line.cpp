// Any arguments, one per line, are understood or refused with a message; no command is run.
// Arguments that are understood can be written as a job (--dump-config), and the job means the same
// arguments.
#include "commands/command_line.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/job_file.h"
#include "commands/effective_job.h"
#include "commands/many_files.h"
#include "fuzz/targets.h"
#include "support/mesh_io.h"

namespace ibmfair::fuzz {

namespace {

using commands::CommandLine;

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Only ASCII names are compared: JSON is UTF-8, but names of files need not be.
bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > 0; });
}

/// The arguments that a batch would run the job with.
std::vector<std::string> words_of(const commands::Job& job, CLI::App& command) {
  std::vector<commands::Setting> settings = job.settings;
  if (const CLI::Option* input = commands::input_argument(command); input != nullptr) {
    settings.push_back({commands::key_of(*input), true, job.inputs});
  }
  return commands::words_for(command, settings);
}

/// A text that is equal for two commands that do the same. A job writes the file name `-a` as
/// `./-a`.
std::string meaning_of(CommandLine& line) {
  const std::string text = commands::job_file_text({commands::effective_job(line.command())});
  return test::replaced(text, "\"./-", "\"-");
}

void require_same_as_job(CommandLine& line) {
  const std::string text = commands::job_file_text({commands::effective_job(line.command())});
  const std::vector<commands::Job> jobs = commands::parse_jobs(text, "dump");
  law(jobs.size() == 1, "one command is one job");
  CommandLine again(jobs.front().command);
  const auto answer = again.parse(words_of(jobs.front(), again.command()));
  law(!answer, "a job's arguments ask for no help");
  law(meaning_of(again) == meaning_of(line), "a job means what it came from: " + text);
}

}  // namespace

void command_line(std::string_view bytes) {
  const std::vector<std::string> words = lines_of(bytes);
  CommandLine line;
  try {
    if (const auto answer = line.parse(words)) {
      law(!answer->empty(), "who asks for help gets some");
      return;
    }
  } catch (const BadOption& error) {
    law(*error.what() != '\0', "a refusal says why");
    law(!line.help_hint().empty(), "and where help is");
    return;
  }
  if (!commands::takes_many_files(line.command()) && line.command().get_name() != "batch" &&
      is_ascii(bytes)) {
    require_same_as_job(line);
  }
}

}  // namespace ibmfair::fuzz
