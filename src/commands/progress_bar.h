// A line on a terminal that shows how far the flow is.
#pragma once

#include <chrono>

#include "commands/console.h"
#include "ibmfair/flow/flow_options.h"

namespace ibmfair::commands {

/// Draws on standard error where that is a terminal and the console is not quiet; otherwise silent.
class ProgressBar {
 public:
  ProgressBar(const Console& console, double total_time);
  /// Clears the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const StepRecord& step);

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  double total_time_;
  Clock::time_point start_;
};

}  // namespace ibmfair::commands
