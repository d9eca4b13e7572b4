#include "commands/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "commands/crash_message.h"
#include "commands/terminal_line.h"

namespace ibmfair::commands {

namespace {

using namespace std::chrono_literals;

constexpr auto pause_between_frames = 100ms;
constexpr double seconds_to_mention = 2;  // shorter stages show no time
constexpr int bar_width = 24;
constexpr std::size_t usual_columns = 80;  // if the terminal does not report its width

std::string bar(double share) {
  const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * bar_width);
  return fmt::format("[{:=<{}}{: <{}}]", "", filled, "", bar_width - filled);
}

/// `8 s`, `2 min 05 s`, `3 h 20 min`.
std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::min(seconds, 1e9)));
  if (whole < 60) {
    return fmt::format("{} s", whole);
  }
  return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                      : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string_view word_for(FlowStage stage) {
  switch (stage) {
    case FlowStage::analyse:
      return "analyse";
    case FlowStage::factor:
      return "factor";
    case FlowStage::solve:
      break;
  }
  return "";
}

bool can_go_back_in_line() {
  const char* terminal = std::getenv("TERM");
  return terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace

std::string progress_line(const ProgressState& state, std::size_t columns) {
  std::vector<std::string> parts{state.stage};
  if (!state.detail.empty()) {
    parts.push_back(state.detail);
  }
  if (state.share && *state.share > state.first_share && *state.share < 1) {
    const double done = *state.share - state.first_share;
    parts.push_back(duration(state.seconds * (1 - *state.share) / done) + " left");
  } else if (state.seconds >= seconds_to_mention) {
    parts.push_back(duration(state.seconds));
  }
  if (state.energy) {
    parts.push_back(fmt::format("energy {:.4g}", *state.energy));
  }
  std::string line = state.share && bar_width + 12 < columns ? bar(*state.share) + " " : "";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string next = (i == 0 ? "" : ", ") + parts[i];
    if (line.size() + next.size() > columns) {
      break;
    }
    line += next;
  }
  return line;
}

Progress::Progress(const Console& console)
    : listener_(console.listener()),
      visible_(console.on_terminal() && console.level() != Console::Level::quiet &&
               can_go_back_in_line()) {
  if (visible_) {
    try {
      drawer_ = std::thread(&Progress::draw_until_end, this);
    } catch (const std::system_error&) {
      visible_ = false;  // without a thread nothing is drawn
    }
  }
}

Progress::~Progress() {
  end();
}

void Progress::end() {
  if (drawer_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_one();
    drawer_.join();
    clear_terminal_line();
  }
}

template <class Change>
void Progress::change(const Change& make) {
  {
    const std::lock_guard lock(mutex_);
    make();
    if (listener_ == nullptr) {
      note_stage(state_.stage, state_.detail);
    }
  }
  if (listener_ != nullptr) {
    listener_->progress(state_);
  }
  changed_.notify_one();
}

void Progress::begin(const std::string& stage) {
  change([&] {
    state_ = {};
    state_.stage = stage;
    start_ = Clock::now();
  });
}

void Progress::begin_work(const std::string& stage) {
  begin(stage);
  change([&] { state_.share = 0; });
}

void Progress::advance(const std::string& stage, double share) {
  change([&] {
    state_.stage = stage;
    state_.share = share;
  });
}

void Progress::advance(const StepRecord& step, int steps, double total_time) {
  change([&] {
    // The time before the first step, for example for a factorization, says nothing about the
    // remaining steps.
    if (step.step == 1) {
      start_ = Clock::now();
      state_.first_share = step.time / total_time;
    }
    // A guarded flow can shorten steps, and then takes more steps than were requested.
    state_.stage = step.step > 0
                       ? fmt::format("step {} of {}", step.step, std::max(step.step, steps))
                       : "first stage";
    state_.share = step.time / total_time;
    state_.energy = step.energy;
  });
}

void Progress::enter(FlowStage stage) {
  change([&] { state_.detail = word_for(stage); });
}

void Progress::draw_until_end() {
  try {
    draw_frames();
  } catch (const std::bad_alloc&) {
    // Drawing ends silently; the computation itself may still have enough memory.
  }
}

void Progress::draw_frames() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    if (!state_.stage.empty()) {
      ProgressState state = state_;
      state.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
      lock.unlock();
      // Three columns stay free, so that the terminal's echo of Ctrl-C fits into the line.
      const std::size_t known = terminal_columns(STDERR_FILENO);
      const std::size_t columns = known > 0 ? known : usual_columns;
      show_terminal_line(progress_line(state, columns > 3 ? columns - 3 : 0));
      lock.lock();
      changed_.wait_for(lock, pause_between_frames, [this] { return ended_; });
    } else {
      changed_.wait(lock);
    }
  }
}

}  // namespace ibmfair::commands
