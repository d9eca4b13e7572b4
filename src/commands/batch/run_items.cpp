#include "commands/batch/run_items.h"

#include <algorithm>
#include <filesystem>

#include "commands/batch/interrupts.h"
#include "commands/batch/resume.h"
#include "commands/batch/running_item.h"
#include "commands/exit_code.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

Outcome ended(Status status, ExitCode code) {
  Outcome outcome;
  outcome.status = status;
  outcome.exit_code = static_cast<int>(code);
  return outcome;
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
      take(next_++);
    }
  }

  /// Starts the item, unless the outcome of an earlier run is still valid.
  void take(std::size_t index) {
    const Item& item = items_[index];
    RunningItem running{index, &item, journal_key(item, settings_.list_journal),
                        begin_record(item)};
    if (settings_.resume) {
      if (const auto outcome = still_valid(item, earlier_.finished(running.key))) {
        return conclude(index, *outcome);
      }
    }
    start(std::move(running));
  }

  void start(RunningItem running) {
    const Item& item = *running.item;
    const bool ours = settings_.resume && earlier_.started(running.key);
    const bool overwrite =
        item.overwrite || (item.takes_overwrite && (settings_.overwrite || ours));
    if (const std::string path = overwrite ? "" : file_in_the_way(item); !path.empty()) {
      // The child process would refuse as well, but then the journal would record the existing file
      // as the batch's own.
      Outcome outcome = ended(Status::failed, ExitCode::cannot_write);
      outcome.message =
          path + (settings_.resume ? ": exists already, and " + settings_.list_journal +
                                         " does not record that this list has made it; --overwrite "
                                         "replaces it, --journal names another record"
                                   : ": exists already; --overwrite replaces it, --resume skips "
                                     "what is done");
      running.record.outcome = outcome;
      journal_.add_refusal(running.key, running.record);
      return conclude(running.index, outcome);
    }
    for (const std::string& folder : output_folders(item)) {
      std::error_code ignored;  // the child process will report the error
      fs::create_directories(folder, ignored);
    }
    journal_.add_start(running.key);
    running.start_process(overwrite, settings_.threads);
    running_.push_back(std::move(running));
    // The inputs are hashed while the child process computes. The file is read from disk only once,
    // because the second reader finds it in the page cache.
    running_.back().inputs_known = add_hashes(item, running_.back().record);
  }

  void wait() {
    std::vector<pollfd> waits;
    for (const RunningItem& running : running_) {
      running.process->append_waits(waits);
    }
    interrupts_.wait(waits);
    result_.signal_number = interrupts_.signal_number();
    if (result_.signal_number != 0) {
      return;  // items that the same Ctrl-C has ended must not count as failed
    }
    for (std::size_t i = 0; i < running_.size();) {
      if (running_[i].process->read_streams()) {
        const RunningItem running = std::move(running_[i]);
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
        finish(running);
      } else {
        ++i;
      }
    }
  }

  void finish(const RunningItem& running) {
    const Outcome outcome = running.wait_for_end();
    journal_.add_end(running.key, running.record_of_end(outcome));
    conclude(running.index, outcome);
  }

  void stop() {
    for (const RunningItem& running : running_) {
      running.kill_process();
      Outcome outcome = ended(Status::interrupted, ExitCode::interrupted);
      outcome.seconds = running.seconds();
      conclude(running.index, outcome);
    }
    running_.clear();
  }

  void conclude(std::size_t index, const Outcome& outcome) {
    failed_ = failed_ || outcome.status == Status::failed;
    result_.outcomes[index] = outcome;
    observe_(index, outcome);
  }

  const std::vector<Item>& items_;
  const RunSettings& settings_;
  const JournalRecord& earlier_;
  Journal& journal_;
  const OutcomeObserver& observe_;
  Interrupts interrupts_;
  std::vector<RunningItem> running_;
  std::size_t next_ = 0;
  bool failed_ = false;
  RunResult result_;
};

}  // namespace

RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal,
                    const OutcomeObserver& observe) {
  return ItemRunner(items, settings, earlier, journal, observe).run();
}

}  // namespace ibmfair::commands
