#include "commands/crash_message.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

#include "ibmfair/base/instruction_set.h"
#include "ibmfair/base/version.h"

namespace ibmfair::commands {

namespace {

/// Text in static memory, without allocation; text beyond the capacity is dropped.
template <std::size_t capacity>
class FixedText {
 public:
  FixedText& add(std::string_view text) {
    const std::size_t count = std::min(text.size(), capacity - size_);
    std::copy_n(text.data(), count, bytes_.data() + size_);
    size_ += count;
    return *this;
  }
  void clear() { size_ = 0; }
  std::string_view view() const { return {bytes_.data(), size_}; }

 private:
  std::array<char, capacity> bytes_{};
  std::size_t size_ = 0;
};

// Two buffers, because a crash can happen while a stage is being written: the shown buffer is never
// written to.
std::array<FixedText<100>, 2> stages;
std::atomic<std::size_t> shown_stage{0};
static_assert(std::atomic<std::size_t>::is_always_lock_free);

std::string_view signal_name(int signal_number) {
  switch (signal_number) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGILL:
      return "SIGILL";
    case SIGFPE:
      return "SIGFPE";
    case SIGABRT:
      return "SIGABRT";
    default:
      return "a signal";
  }
}

}  // namespace

void note_stage(std::string_view stage, std::string_view detail) {
  const std::size_t next = 1 - shown_stage.load(std::memory_order_relaxed);
  stages[next].clear();
  stages[next].add(stage);
  if (!detail.empty()) {
    stages[next].add(", ").add(detail);
  }
  shown_stage.store(next, std::memory_order_release);
}

std::string_view crash_message(int signal_number) {
  static FixedText<1000> text;
  const std::string_view stage = stages[shown_stage.load(std::memory_order_acquire)].view();
  text.clear();
  text.add("ibmfair: error: the program crashed (").add(signal_name(signal_number));
  text.add(", version ").add(version()).add(", kernels ").add(kernel_set_name());
  text.add(", stage: ").add(stage.empty() ? "start" : stage).add(")\n");
  text.add(
      "ibmfair: no file is left half written. Please report this with the line above, the "
      "command, the output of `ibmfair --version`, and the input file if you may share it.\n");
  if (kernel_set() != InstructionSet::baseline) {
    text.add("ibmfair: IBMFAIR_KERNELS=baseline in the environment may avoid the crash.\n");
  }
  return text.view();
}

}  // namespace ibmfair::commands
