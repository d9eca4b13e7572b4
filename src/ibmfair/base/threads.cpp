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

#include <dlfcn.h>
#include <sys/mman.h>
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

/// The function with this name in the loaded libraries, or null.
template <class Function>
Function* loaded_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// Whether the process can get this many more bytes of address space.
bool can_map(std::size_t bytes) {
  constexpr int no_file = -1;
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, no_file, 0);
  return memory != MAP_FAILED && munmap(memory, bytes) == 0;
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

void end_blas_threads() {
  auto* const thread_count = loaded_function<int()>("openblas_get_num_threads");
  auto* const set_threads = loaded_function<void(int)>("openblas_set_num_threads");
  auto* const end_threads = loaded_function<int()>("blas_thread_shutdown_");
  if (thread_count == nullptr || set_threads == nullptr || end_threads == nullptr) {
    return;
  }
  // A thread of OpenBLAS that cannot allocate its buffer tries again for ever, and ending the
  // threads would wait for it for ever.
  constexpr std::size_t buffer_bytes = std::size_t{128} << 20U;
  if (can_map(static_cast<std::size_t>(thread_count()) * buffer_bytes)) {
    set_threads(1);  // must come first, because this call starts threads if there are none
    end_threads();
  }
}

}  // namespace ibmfair
