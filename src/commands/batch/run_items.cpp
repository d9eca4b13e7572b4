#include "commands/batch/run_items.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "commands/batch/interrupts.h"
#include "commands/batch/item_queue.h"
#include "commands/batch/resume.h"
#include "commands/batch/running_item.h"
#include "commands/batch/temporaries.h"
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
             const JournalRecord& earlier, Journal& journal, SharedList* shared,
             const RunObserver& observer)
      : items_(items),
        settings_(settings),
        earlier_(earlier),
        journal_(journal),
        shared_(shared),
        observer_(observer),
        queue_(items.size(),
               shared == nullptr ? std::chrono::milliseconds(0) : shared->longest_pause()) {
    result_.outcomes.resize(items.size());
    looked_up_.resize(items.size());
  }

  RunResult run() {
    while (true) {
      start_more();
      if (result_.signal_number != 0) {
        stop();
      }
      if (running_.empty() && (queue_.empty() || may_not_start())) {
        clear_up();
        return std::move(result_);
      }
      wait();
    }
  }

 private:
  bool has_place() const { return running_.size() < static_cast<std::size_t>(settings_.jobs); }

  bool may_not_start() const {
    return result_.signal_number != 0 || (failed_ && settings_.fail_fast);
  }

  void start_more() {
    while (has_place()) {
      result_.signal_number = interrupts_.signal_number();
      if (may_not_start()) {
        return;
      }
      const std::optional<std::size_t> index = queue_.next();
      if (!index) {
        return;
      }
      take(*index);
    }
  }

  /// Starts the item, unless an earlier outcome is still valid or another process runs the item.
  void take(std::size_t index) {
    const Item& item = items_[index];
    RunningItem running{index, &item, journal_key(item, settings_.list_journal),
                        begin_record(item)};
    if (!looked_up_[index]) {
      looked_up_[index] = true;
      if (const auto outcome = earlier_outcome(item, running.key)) {
        return conclude(index, *outcome);
      }
    }
    if (shared_ != nullptr) {
      if (const auto outcome = shared_->ended(item, running.key)) {
        return conclude(index, *outcome);
      }
      running.claim = shared_->claim(running.key);
      if (!running.claim) {
        return queue_.put_back(index);
      }
      if (const auto outcome = shared_->ended(item, running.key)) {
        return conclude(index, *outcome);  // recorded just before the claim was given up
      }
      for (const AbandonedRun& run : running.claim->abandoned()) {
        remove_temporaries_of(run.process, output_folders(item), run.end);
      }
    }
    start(std::move(running));
  }

  /// The outcome of a run before this one, if it is still valid.
  std::optional<Outcome> earlier_outcome(const Item& item, const std::string& key) const {
    if (!goes_on()) {
      return std::nullopt;
    }
    if (auto outcome = still_valid(item, earlier_.finished(key))) {
      return outcome;
    }
    // A process that joins a shared list late does not retry items at which others have failed.
    const Finished* last = earlier_.last(key);
    const bool failed = last != nullptr && last->outcome.status == Status::failed;
    return failed && !settings_.resume && !last->refused && same_task(item, *last)
               ? std::optional(last->outcome)
               : std::nullopt;
  }

  /// Whether this run continues a list that other runs have started.
  bool goes_on() const { return settings_.resume || shared_ != nullptr; }

  bool is_ours(const std::string& key) const {
    return goes_on() && (earlier_.started(key) || (shared_ != nullptr && shared_->started(key)));
  }

  void start(RunningItem running) {
    const Item& item = *running.item;
    const bool overwrite =
        item.overwrite || (item.takes_overwrite && (settings_.overwrite || is_ours(running.key)));
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
    if (running_.empty() && !waits_for_others_) {
      waits_for_others_ = true;
      observer_.waits(queue_.size());
    }
    std::vector<pollfd> waits;
    for (const RunningItem& running : running_) {
      running.process->append_waits(waits);
    }
    interrupts_.wait(waits, time_to_wait());
    result_.signal_number = interrupts_.signal_number();
    if (result_.signal_number != 0) {
      return;  // items that the same Ctrl-C has ended must not count as failed
    }
    for (std::size_t i = 0; i < running_.size();) {
      const bool ended = running_[i].process->read_streams();
      if (const bool lost = is_lost(running_[i], ended); ended || lost) {
        const RunningItem running = std::move(running_[i]);
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
        lost ? leave_to_others(running) : finish(running);
      } else {
        ++i;
      }
    }
  }

  /// Whether another process has taken over the item. If the item has `ended`, the claim is checked
  /// now.
  static bool is_lost(const RunningItem& running, bool ended) {
    if (running.claim && ended) {
      running.claim->renew();
    }
    return running.claim && running.claim->lost();
  }

  /// The longest time to wait; no limit if the only possible event is the end of a child process.
  std::optional<std::chrono::milliseconds> time_to_wait() const {
    if (shared_ == nullptr) {
      return std::nullopt;
    }
    constexpr std::chrono::milliseconds until_claims_are_checked{1000};
    return has_place() && !queue_.empty() ? std::min(queue_.pause(), until_claims_are_checked)
                                          : until_claims_are_checked;
  }

  /// Gives the item up to another process, which started it because this process seemed to be dead.
  void leave_to_others(const RunningItem& running) {
    running.kill_process();
    queue_.put_back(running.index);
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

  void clear_up() const {
    if (shared_ == nullptr || !queue_.empty() || may_not_start()) {
      return;
    }
    std::vector<std::string> keys;
    keys.reserve(items_.size());
    for (const Item& item : items_) {
      keys.push_back(journal_key(item, settings_.list_journal));
    }
    shared_->clear_up(keys);
  }

  void conclude(std::size_t index, const Outcome& outcome) {
    failed_ = failed_ || outcome.status == Status::failed;
    result_.outcomes[index] = outcome;
    observer_.ended(index, outcome);
  }

  const std::vector<Item>& items_;
  const RunSettings& settings_;
  const JournalRecord& earlier_;
  Journal& journal_;
  SharedList* shared_;
  const RunObserver& observer_;
  Interrupts interrupts_;
  ItemQueue queue_;
  std::vector<bool> looked_up_;  // whether earlier runs of the item have been looked up
  std::vector<RunningItem> running_;
  bool failed_ = false;
  bool waits_for_others_ = false;
  RunResult result_;
};

}  // namespace

RunResult run_items(const std::vector<Item>& items, const RunSettings& settings,
                    const JournalRecord& earlier, Journal& journal, SharedList* shared,
                    const RunObserver& observer) {
  return ItemRunner(items, settings, earlier, journal, shared, observer).run();
}

}  // namespace ibmfair::commands
