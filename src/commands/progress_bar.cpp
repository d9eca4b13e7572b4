#include "commands/progress_bar.h"

#include <cstdio>

#include <fmt/format.h>

namespace ibmfair::commands {

ProgressBar::ProgressBar(const Console& console, double total_time)
    : visible_(console.on_terminal() && console.level() != Console::Level::quiet),
      total_time_(total_time),
      start_(Clock::now()) {}

ProgressBar::~ProgressBar() {
  if (visible_) {
    std::fputs("\r\033[K", stderr);
  }
}

void ProgressBar::update(const StepRecord& step) {
  if (!visible_) {
    return;
  }
  constexpr int width = 30;
  const double done = step.time / total_time_;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const int filled = static_cast<int>(done * width);
  fmt::print(stderr, "\r\033[K[{:=<{}}{: <{}}] step {}  energy {:.6g}  {:.1f} s left", "", filled,
             "", width - filled, step.step, step.energy,
             done > 0 ? seconds * (1 - done) / done : 0.0);
  std::fflush(stderr);
}

}  // namespace ibmfair::commands
