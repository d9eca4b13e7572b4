#include "commands/batch/run_items.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "commands/batch/child_process.h"
#include "commands/batch/child_report.h"
#include "commands/batch/interrupts.h"
#include "commands/batch/resume.h"
#include "commands/batch/temporaries.h"
#include "commands/exit_code.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Running {
  std::size_t index;
  std::string key;
  Finished record;
  bool inputs_known = false;  // they did not change while they were hashed
  Clock::time_point start = Clock::now();
  std::unique_ptr<ChildProcess> process = nullptr;
};

/// The first file that the item would replace without being allowed to; empty: none.
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

Outcome ended(Status status, ExitCode code) {
  Outcome outcome;
  outcome.status = status;
  outcome.exit_code = static_cast<int>(code);
  return outcome;
}

std::string signal_text(int signal_number) {
  return fmt::format("ended by signal {} ({}){}", signal_number, strsignal(signal_number),
                     signal_number == SIGKILL ? ", perhaps for want of memory" : "");
}

class ItemRunner {
 public:
  ItemRunner(const std::vector<Item>& items, const RunSettings& settings,
             const JournalRecord& earlier, Journal& journal, const OutcomeObserver& observe)
      : items_(items),
        settings_(settings),
        earlier_(earlier),
        journal_(journal),
        observe_(observe) {
    result_.outcomes.resize(items.size());
  }

  RunResult run() {
    while (true) {
      start_more();
      if (result_.signal_number != 0) {
        stop();
      }
      if (running_.empty()) {
        return std::move(result_);
      }
      wait();
    }
  }

 private:
  void start_more() {
    while (next_ < items_.size() && running_.size() < static_cast<std::size_t>(settings_.jobs)) {
      result_.signal_number = interrupts_.signal_number();
      if (result_.signal_number != 0 || (failed_ && settings_.fail_fast)) {
        return;
      }
      start(next_++);
    }
  }

  void start(std::size_t index) {
    const Item& item = items_[index];
    Running running{index, journal_key(item, settings_.list_journal), begin_record(item)};
    const bool ours = settings_.resume && earlier_.started(running.key);
    if (settings_.resume) {
      if (const auto outcome = still_valid(item, earlier_.finished(running.key))) {
        return conclude(index, *outcome);
      }
    }
    const bool overwrite =
        item.overwrite || (item.takes_overwrite && (settings_.overwrite || ours));
    if (const std::string path = overwrite ? "" : file_in_the_way(item); !path.empty()) {
      // Its process would refuse, too; but what is in the way must not be noted as ours.
      Outcome outcome = ended(Status::failed, ExitCode::cannot_write);
      outcome.message =
          path + ": exists already; --overwrite replaces it, --resume skips what is done";
      running.record.outcome = outcome;
      journal_.add_refusal(running.key, running.record);
      return conclude(index, outcome);
    }
    for (const std::string& folder : output_folders(item)) {
      std::error_code ignored;  // its process will tell
      fs::create_directories(folder, ignored);
    }
    journal_.add_start(running.key);
    running.process = std::make_unique<ChildProcess>(words_of(item, overwrite));
    running_.push_back(std::move(running));
    // While it computes; it has read the file by then or finds it in memory.
    running_.back().inputs_known = add_hashes(item, running_.back().record);
  }

  std::vector<std::string> words_of(const Item& item, bool overwrite) const {
    std::vector<std::string> words = item.words;
    if (item.takes_json) {
      words.emplace_back("--json");
    }
    if (overwrite && !item.overwrite) {
      words.emplace_back("--overwrite");
    }
    if (!item.has_threads) {
      words.push_back(fmt::format("--threads={}", settings_.threads));
    }
    return words;
  }

  void wait() {
    std::vector<pollfd> waits;
    for (const Running& running : running_) {
      running.process->append_waits(waits);
    }
    interrupts_.wait(waits);
    result_.signal_number = interrupts_.signal_number();
    if (result_.signal_number != 0) {
      return;  // those that were stopped by the same key must not count as failed
    }
    for (std::size_t i = 0; i < running_.size();) {
      if (running_[i].process->read_streams()) {
        const Running ended = std::move(running_[i]);
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
        finish(ended);
      } else {
        ++i;
      }
    }
  }

  void finish(const Running& running) {
    const Item& item = items_[running.index];
    const ChildEnd end = running.process->wait();
    Outcome outcome;
    outcome.status = end.exit_code == 0 ? Status::ok : Status::failed;
    outcome.exit_code = end.exit_code;
    outcome.seconds = seconds_since(running.start);
    outcome.peak_megabytes = end.peak_megabytes;
    outcome.message = first_message(running.process->err());
    outcome.figures = main_figures(running.process->out());
    if (end.signal_number != 0) {
      outcome.message = signal_text(end.signal_number);
      remove_temporaries_of(running.process->id(), output_folders(item));
    }
    note_end(item, running, outcome);
    conclude(running.index, outcome);
  }

  void note_end(const Item& item, const Running& running, const Outcome& outcome) {
    Finished record = running.record;
    record.outcome = outcome;
    if (!running.inputs_known && outcome.status == Status::ok) {
      record.inputs.clear();  // resuming redoes it
    }
    for (const std::string& path : item.writes) {
      record.outputs.push_back(stamp_of(path).value_or(FileStamp{}));
    }
    journal_.add_end(running.key, record);
  }

  void stop() {
    for (const Running& running : running_) {
      running.process->kill();
      running.process->wait();
      remove_temporaries_of(running.process->id(), output_folders(items_[running.index]));
      Outcome outcome = ended(Status::interrupted, ExitCode::interrupted);
      outcome.seconds = seconds_since(running.start);
      conclude(running.index, outcome);
    }
    running_.clear();
  }

  void conclude(std::size_t index, const Outcome& outcome) {
    failed_ = failed_ || outcome.status == Status::failed;
    result_.outcomes[index] = outcome;
    observe_(index, outcome);
  }

  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  const std::vector<Item>& items_;
  const RunSettings& settings_;
  const JournalRecord& earlier_;
  Journal& journal_;
  const OutcomeObserver& observe_;
  Interrupts interrupts_;
  std::vector<Running> running_;
  std::size_t next_ = 0;
  bool failed_ = false;
  RunResult result_;
};

}  // namespace

std::set<std::string> output_folders(const Item& item) {
  std::set<std::string> folders;
  for (const std::string& path : item.writes) {
    const fs::path folder = fs::path(path).parent_path();
    folders.insert(folder.empty() ? "." : folder.string());
  }
  return folders;
}

RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal,
                    const OutcomeObserver& observe) {
  return ItemRunner(items, settings, earlier, journal, observe).run();
}

}  // namespace ibmfair::commands
