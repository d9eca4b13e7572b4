// What a command is doing, in a line at the bottom of the terminal.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "commands/console.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair::commands {

/// Where a command is.
struct ProgressState {
  std::string stage;             ///< "read", "step 5 of 16", "hole 3 of 12"
  std::string detail;            ///< of a stage that is part of another: "factor"
  std::optional<double> share;   ///< done of a work whose size is known, 0 to 1
  double first_share = 0;        ///< done when the clock was started
  std::optional<double> energy;  ///< reached
  double seconds = 0;            ///< since the stage, or that work, began
};

/// One line of at most `columns` bytes: what fits of bar, stage, energy and the time that is left.
std::string progress_line(const ProgressState& state, std::size_t columns);

/// Draws on standard error where that is a terminal that can go back in its line (not TERM=dumb)
/// and the console is not quiet, ten times a second at most, and clears the line in the end.
/// Everywhere it notes the stage for the message of a crash (commands/crash_message.h).
class Progress {
 public:
  explicit Progress(const Console& console);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A stage of which nobody knows how long it takes.
  void begin(const std::string& stage);

  /// A work of known size starts; what comes next are shares of it.
  void begin_work(const std::string& stage);
  void advance(const std::string& stage, double share);

  /// A step of a flow of `steps` steps, which lasts for `total_time`.
  void advance(const StepRecord& step, int steps, double total_time);
  void enter(FlowStage stage);

  /// Nothing is drawn any more.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  template <class Change>
  void change(const Change& make);
  void draw_until_end();
  void draw_frames();

  bool visible_;
  std::mutex mutex_;
  std::condition_variable changed_;
  ProgressState state_;
  Clock::time_point start_ = Clock::now();
  bool ended_ = false;
  std::thread drawer_;  // so that a stage that takes long shows its time
};

}  // namespace ibmfair::commands
