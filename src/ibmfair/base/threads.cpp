#include "ibmfair/base/threads.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <latch>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"

namespace ibmfair {
namespace {

/// The thread count that OMP_NUM_THREADS asks for, or 0.
int environment_thread_count() {
  const char* text = std::getenv("OMP_NUM_THREADS");
  const std::string_view digits = text != nullptr ? text : "";
  int count = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), count);
  return std::clamp(count, 0, largest_thread_count);
}

/// The number of threads, at most `wanted` and including the calling one, that can exist at the
/// same time.
int possible_threads(int wanted) {
  std::vector<std::thread> others;
  others.reserve(static_cast<std::size_t>(wanted));
  std::latch end(1);
  try {
    while (static_cast<int>(others.size()) + 1 < wanted) {
      others.emplace_back([&end] { end.wait(); });
    }
  } catch (const std::system_error&) {  // there is no memory for the stack of another thread
  }
  end.count_down();
  for (std::thread& thread : others) {
    thread.join();
  }
  return static_cast<int>(others.size()) + 1;
}

}  // namespace

void set_thread_count(int count) {
  if (count < 0 || count > largest_thread_count) {
    throw BadOption("cannot use " + std::to_string(count) + " threads: give 0 (all) to " +
                    std::to_string(largest_thread_count));
  }
  static std::optional<tbb::global_control> limit;
  limit.reset();
  if (count = count > 0 ? count : environment_thread_count(); count > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  }
  if (std::isfinite(address_space_limit())) {
    // If TBB later failed to start a thread, the program would end; so the limit is the number of
    // threads that can be started. They are started now, while there is room for them.
    const int possible = possible_threads(thread_count());
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(possible));
    tbb::parallel_for(0, possible, [](int) {});
  }
}

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

int worker_count() {
  return std::max(thread_count(), tbb::this_task_arena::max_concurrency());
}

int worker_index() {
  return std::max(0, tbb::this_task_arena::current_thread_index());
}

}  // namespace ibmfair
