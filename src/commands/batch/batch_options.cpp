#include "commands/batch/batch_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "commands/report/report_formats.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"

namespace ibmfair::commands {

namespace {

constexpr std::int64_t most_parts = 1'000'000;

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    throw BadOption(fmt::format("--shard: '{}' is not of the form I/N, as 3/8", text));
  }
  const auto count = parse_integer_option("--shard", text.substr(slash + 1), 1, most_parts);
  const auto number = parse_integer_option("--shard", text.substr(0, slash), 1, count);
  return {static_cast<std::size_t>(number), static_cast<std::size_t>(count)};
}

}  // namespace

std::vector<CLI::Option*> add_batch_options(CLI::App& app, BatchOptions& options) {
  std::vector<CLI::Option*> added;
  added.push_back(add_integer(
      app, "--jobs", options.jobs, 0, largest_thread_count,
      "number of files to process at the same time; they share the cores; 0 means one per core"));
  note_of(app, *added.back()).unit = "files";
  added.push_back(app.add_flag("--fail-fast,!--keep-going", options.fail_fast,
                               "start no further file after one has failed; --keep-going, the "
                               "default, continues with the others"));
  CLI::Option* resume = app.add_flag("--resume", options.resume,
                                     "skip files that an earlier run has finished and that have "
                                     "not changed; replace its other outputs");
  added.push_back(resume);
  added.push_back(add_parsed_option(
      app, "--shard", "I/N", "run part I of N parts of the list, counted from 1",
      [&options](const std::string& text) { options.shard = parse_shard(text); }));
  note_of(app, *added.back()).default_text = "1/1";
  CLI::Option* shard = added.back();
  if (app.get_option_no_throw("--dry-run") == nullptr) {
    added.push_back(
        app.add_flag("--dry-run", options.dry_run,
                     "print what would be run, the command of each file, and write nothing"));
  }
  added.push_back(
      app.add_flag(
             "--merge", options.merge,
             "run nothing, but write the summary of the whole list from the records of all parts")
          ->excludes(shard)
          ->excludes(resume)
          ->excludes(app.get_option("--dry-run")));
  // If a command takes many files, its --report names the reports about the single files.
  const bool has_reports = app.get_option_no_throw("--report") != nullptr;
  options.report.option = "--summary";
  added.push_back(app.add_option(has_reports ? "--summary" : "--summary,--report",
                                 options.report.paths,
                                 "write the result of every file to this .csv, .json or .html "
                                 "file; can be given several times")
                      ->type_name(file_to_write)
                      ->allow_extra_args(false));
  note_of(app, *added.back()).extensions = report_extensions();
  added.push_back(
      app.add_option("--journal", options.journal, "file for the records that --resume reads")
          ->type_name(file_to_write));
  note_of(app, *added.back()).default_text =
      "JOBS.journal, or .ibmfair-batch.journal in the output folder";
  for (CLI::Option* option : added) {
    option->configurable(false);
  }
  return added;
}

std::vector<Item> items_of_shard(std::vector<Item> items, const Shard& shard) {
  std::vector<Item> part;
  for (Item& item : items) {
    if ((item.number - 1) % shard.count == shard.number - 1) {
      part.push_back(std::move(item));
    }
  }
  return part;
}

}  // namespace ibmfair::commands
