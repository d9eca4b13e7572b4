#include "commands/batch/run_batch.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/batch/journal.h"
#include "commands/batch/merge.h"
#include "commands/batch/resume.h"
#include "commands/batch/run_items.h"
#include "commands/batch/running_item.h"
#include "commands/batch/shell_words.h"
#include "commands/batch/summary.h"
#include "commands/batch/temporaries.h"
#include "commands/effective_job.h"
#include "commands/report/report_formats.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/base/threads.h"

namespace ibmfair::commands {

namespace {

/// Whether reports may be replaced. A run that continues an earlier run replaces its reports.
bool may_replace_reports(const BatchOptions& options) {
  return options.overwrite || options.resume || options.merge;
}

RunSettings run_settings(const BatchOptions& options, std::size_t items,
                         const std::string& list_journal) {
  RunSettings settings;
  settings.list_journal = list_journal;
  const int cores = thread_count();
  settings.jobs = options.jobs > 0 ? options.jobs : cores;
  // If there are fewer items than jobs, the items share all cores.
  const int busy = static_cast<int>(std::min<std::size_t>(settings.jobs, std::max(items, 1UL)));
  settings.threads = options.threads > 0 ? options.threads : std::max(1, cores / busy);
  settings.fail_fast = options.fail_fast;
  settings.resume = options.resume;
  settings.overwrite = options.overwrite;
  return settings;
}

/// Prints the commands that would be run; for a run that continues another, the remaining commands.
void print_commands(const std::vector<Item>& items, const JournalRecord& earlier,
                    const std::string& journal) {
  std::string text;
  for (const Item& item : items) {
    if (!still_valid(item, earlier.finished(journal_key(item, journal)))) {
      text += "ibmfair " + shell_words(item.words) + "\n";
    }
  }
  write_standard_output(text);
}

void print_jobs(const std::vector<Item>& items) {
  std::vector<nlohmann::ordered_json> jobs;
  jobs.reserve(items.size());
  for (const Item& item : items) {
    if (!item.job_is_exact) {
      throw BadOption(item.label() + ": a job file cannot hold names that are not UTF-8");
    }
    jobs.push_back(nlohmann::ordered_json::parse(item.job));
  }
  write_standard_output(job_file_text(jobs));
}

void clear_away_temporaries(const std::vector<Item>& items, bool others_work,
                            const Console& console) {
  std::set<std::string> folders;
  for (const Item& item : items) {
    folders.merge(output_folders(item));
  }
  if (const int removed = remove_stale_temporaries(folders, others_work); removed > 0) {
    console.note(fmt::format("removed {} unfinished file{} of a killed run", removed,
                             removed == 1 ? "" : "s"));
  }
}

void write_reports(const CLI::App& command, const BatchOptions& options,
                   const std::vector<Item>& items, const std::vector<Outcome>& outcomes,
                   double seconds) {
  Report report(command);
  report.figures["command"] = "batch";  // also if `command` is a command with many files
  add_summary(items, outcomes, seconds, report);
  deliver_report(options.report, may_replace_reports(options), report);
}

bool any_is(Status status, const std::vector<Outcome>& outcomes) {
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [&](const Outcome& outcome) { return outcome.status == status; });
}

ExitCode exit_code_of(const RunResult& result) {
  if (result.signal_number != 0) {
    return static_cast<ExitCode>(128 + result.signal_number);
  }
  return any_is(Status::failed, result.outcomes) ? ExitCode::not_reached : ExitCode::done;
}

ExitCode merge(const CLI::App& command, const BatchOptions& options, const std::vector<Item>& items,
               const std::string& list_journal, const Console& console) {
  const JournalRecord record(journals_of_list(list_journal));
  const std::vector<Outcome> outcomes = merged_outcomes(items, record, list_journal);
  double seconds = 0;
  for (const Outcome& outcome : outcomes) {
    seconds += outcome.seconds;
  }
  console.note(summary_line(outcomes, seconds), summary_table(items, outcomes));
  write_reports(command, options, items, outcomes, seconds);
  const bool all_done = !any_is(Status::failed, outcomes) && !any_is(Status::not_run, outcomes);
  return all_done ? ExitCode::done : ExitCode::not_reached;
}

/// The records of earlier runs; none unless this run continues them.
JournalRecord read_earlier(const BatchOptions& options, const std::string& list_journal) {
  return options.resume ? JournalRecord(journals_of_list(list_journal)) : JournalRecord();
}

void make_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) {
    std::error_code ignored;  // opening the file will report the error
    std::filesystem::create_directories(folder, ignored);
  }
}

RunResult run_and_tell(const std::vector<Item>& items, std::size_t total,
                       const RunSettings& settings, const JournalRecord& earlier, Journal& journal,
                       const Console& console) {
  const auto tell = [&](std::size_t index, const Outcome& outcome) {
    const std::string line = status_line(items[index], outcome, total);
    if (outcome.status == Status::failed && console.level() == Console::Level::quiet) {
      console.error(line);
    } else {
      console.note(line);
    }
  };
  return run_items(items, settings, earlier, journal, tell);
}

}  // namespace

ExitCode run_batch(const CLI::App& command, const std::vector<Job>& jobs,
                   const BatchOptions& options, const std::string& journal, Console& console) {
  check_reports(options.report, {}, may_replace_reports(options));
  const std::vector<Item> all = expand_jobs(jobs);
  const std::vector<Item> items = items_of_shard(all, options.shard);
  if (options.dump_config) {
    print_jobs(items);
    return ExitCode::done;
  }
  const std::string list_journal = options.journal.empty() ? journal : options.journal;
  if (options.merge) {
    return merge(command, options, all, list_journal, console);
  }
  if (options.dry_run) {
    print_commands(items, read_earlier(options, list_journal), list_journal);
    return ExitCode::done;
  }
  make_folder_of(list_journal);
  const std::string own_journal =
      journal_of_shard(list_journal, options.shard.number, options.shard.count);
  Journal record(own_journal);
  if (!record.locked()) {
    console.warning(own_journal +
                    ": the file system cannot lock this file, so a second run of the same files "
                    "at the same time is not noticed");
  }
  // The records are read after the journal is locked: a run that has just ended has added to them.
  const JournalRecord earlier = read_earlier(options, list_journal);
  if (options.resume) {
    clear_away_temporaries(items, options.shard.count > 1, console);
  }
  double seconds = 0;
  RunResult result;
  {
    const Stopwatch watch(seconds);
    result = run_and_tell(items, all.size(), run_settings(options, items.size(), list_journal),
                          earlier, record, console);
  }
  // If a signal arrives while no item is running, no status line reports the interruption.
  const std::string how = result.signal_number != 0 ? "interrupted, " : "";
  console.note(how + summary_line(result.outcomes, seconds), summary_table(items, result.outcomes));
  write_reports(command, options, items, result.outcomes, seconds);
  return exit_code_of(result);
}

}  // namespace ibmfair::commands
