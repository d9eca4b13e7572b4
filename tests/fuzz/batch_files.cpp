// Any bytes that are read as a job file are jobs whose arguments can be put together, or are
// refused with a message. Any bytes that are read as the journal of a killed batch yield the
// records that they contain and cause no failure, or are left as they are.
#include <algorithm>

#include <CLI/CLI.hpp>

#include "commands/batch/job_file.h"
#include "commands/batch/journal.h"
#include "commands/batch/name_pattern.h"
#include "commands/command_line.h"
#include "fuzz/mesh_laws.h"
#include "fuzz/targets.h"
#include "support/files.h"
#include "support/temporary_directory.h"

namespace ibmfair::fuzz {

namespace {

void require_runnable(const commands::Job& job) {
  commands::CommandLine line(job.command);
  const auto words = commands::words_for(line.command(), job.settings);
  law(!words.empty() && words.front() == job.command, "a job's arguments start with its command");
  law(job.place.starts_with("jobs: job "), "a job knows its place");
  for (const commands::Setting& setting : job.settings) {
    for (const std::string& value : setting.values) {
      law(value.ends_with('/') ||
              commands::expand_pattern(commands::literal_pattern(value), "a/b.off") == value,
          "every name of a file can be written as a pattern");
      try {
        commands::expand_pattern(value, "a/b.off");
      } catch (const BadOption&) {
        continue;  // braces in the name have no meaning
      }
    }
  }
}

void as_jobs(std::string_view bytes) {
  std::vector<commands::Job> jobs;
  try {
    jobs = commands::parse_jobs(bytes, "jobs");
  } catch (const BadFile& error) {
    // In JSON a carriage return alone does not end a line, but in the texts that require_clear
    // knows it does.
    std::string text(bytes);
    std::replace(text.begin(), text.end(), '\r', ' ');
    require_clear(error, "jobs", text);
  } catch (const BadOption& error) {
    law(std::string_view(error.what()).starts_with("jobs: "), "a refusal says where");
  }
  for (const commands::Job& job : jobs)
    require_runnable(job);
}

void as_journal(std::string_view bytes) {
  static const test::TemporaryDirectory directory;
  const std::string path = directory / "journal";
  test::write_bytes(path, bytes);
  try {
    commands::Journal journal(path);
    journal.add_start("new");
    journal.add_end("new", {});
  } catch (const CannotWrite& error) {
    law(test::read_bytes(path) == bytes, "what is no journal is left as it is");
    law(std::string_view(error.what()).starts_with(path + ": "), "a refusal names the file");
    return;
  }
  const commands::JournalRecord record({path});
  law(record.started("new"), "what is noted after a killed run is read");
  law(!record.finished("new").empty(), "what is noted to be finished is");
}

}  // namespace

void batch_files(std::string_view bytes) {
  as_jobs(bytes);
  as_journal(bytes);
}

}  // namespace ibmfair::fuzz
