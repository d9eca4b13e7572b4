// A progress line at the bottom of the terminal.
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

/// The progress of a command.
struct ProgressState {
  std::string stage;             ///< "read", "step 5 of 16", "hole 3 of 12"
  std::string detail;            ///< a part of the stage: "factor"
  std::optional<double> share;   ///< done share, 0 to 1, of a task of known size
  double first_share = 0;        ///< done share when the clock was started
  std::optional<double> energy;  ///< energy after the last step
  double seconds = 0;            ///< since the start of the stage or of the task
};

/// One line of at most `columns` bytes, with as many of bar, stage, remaining time and energy as
/// fit.
std::string progress_line(const ProgressState& state, std::size_t columns);

/// Draws the progress line, at most ten times a second, and clears it at the end. Draws only if the
/// console is not quiet and standard error is a terminal that supports carriage return (TERM is not
/// "dumb"). Passes every change to the listener of the console, if there is one; otherwise stores
/// the stage for the crash message (commands/crash_message.h).
class Progress {
 public:
  explicit Progress(const Console& console);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts a stage of unknown duration.
  void begin(const std::string& stage);

  /// Starts a task of known size; the following calls of advance() report the share that is done.
  void begin_work(const std::string& stage);
  void advance(const std::string& stage, double share);

  /// Reports a step of a flow of `steps` steps that ends at the time `total_time`.
  void advance(const StepRecord& step, int steps, double total_time);
  void enter(FlowStage stage);

  /// Clears the line and stops drawing.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  template <class Change>
  void change(const Change& make);
  void draw_until_end();
  void draw_frames();

  Listener* const listener_;
  bool visible_;
  std::mutex mutex_;
  std::condition_variable changed_;
  ProgressState state_;
  Clock::time_point start_ = Clock::now();
  bool ended_ = false;
  std::thread drawer_;  // updates the time during long stages
};

}  // namespace ibmfair::commands
