#include "commands/batch/running_item.h"

#include <csignal>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "commands/batch/child_report.h"
#include "commands/batch/temporaries.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> words_of(const Item& item, bool overwrite, int threads) {
  std::vector<std::string> words = item.words;
  if (item.takes_json) {
    words.emplace_back("--json");
  }
  if (overwrite && !item.overwrite) {
    words.emplace_back("--overwrite");
  }
  if (!item.has_threads) {
    words.push_back(fmt::format("--threads={}", threads));
  }
  return words;
}

std::string signal_text(int signal_number) {
  return fmt::format("ended by signal {} ({}){}", signal_number, strsignal(signal_number),
                     signal_number == SIGKILL
                         ? ", perhaps for lack of memory; with a smaller --jobs fewer run at a time"
                         : "");
}

}  // namespace

void RunningItem::start_process(bool overwrite, int threads) {
  start = std::chrono::steady_clock::now();
  process = std::make_unique<ChildProcess>(words_of(*item, overwrite, threads));
}

double RunningItem::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Outcome RunningItem::wait_for_end() const {
  const ChildEnd end = process->wait();
  Outcome outcome;
  outcome.status = end.exit_code == 0 ? Status::ok : Status::failed;
  outcome.exit_code = end.exit_code;
  outcome.seconds = seconds();
  outcome.peak_megabytes = end.peak_megabytes;
  outcome.message = first_message(process->err());
  outcome.figures = main_figures(process->out());
  if (end.signal_number != 0) {
    outcome.message = signal_text(end.signal_number);
    remove_temporaries_of(process->id(), output_folders(*item));
  }
  return outcome;
}

void RunningItem::kill_process() const {
  process->kill();
  process->wait();
  remove_temporaries_of(process->id(), output_folders(*item));
}

Finished RunningItem::record_of_end(const Outcome& outcome) const {
  Finished result = record;
  result.outcome = outcome;
  if (!inputs_known && outcome.status == Status::ok) {
    result.inputs.clear();  // a resumed batch then runs the item again
  }
  for (const std::string& path : item->writes) {
    result.outputs.push_back(stamp_of(path).value_or(FileStamp{}));
  }
  return result;
}

std::string file_in_the_way(const Item& item) {
  for (const std::string& path : item.writes) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_regular_file(status) || fs::is_directory(status)) {
      return path;
    }
  }
  return {};
}

std::set<std::string> output_folders(const Item& item) {
  std::set<std::string> folders;
  for (const std::string& path : item.writes) {
    const fs::path folder = fs::path(path).parent_path();
    folders.insert(folder.empty() ? "." : folder.string());
  }
  return folders;
}

}  // namespace ibmfair::commands
