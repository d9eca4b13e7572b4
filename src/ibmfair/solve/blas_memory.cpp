#include "ibmfair/solve/blas_memory.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>

#include <fmt/format.h>
#include <sys/mman.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"

extern "C" {  // of OpenBLAS
void* blas_memory_alloc(int position);
void blas_memory_free(void* memory);
}

namespace ibmfair {
namespace {

constexpr std::size_t bytes_per_thread = std::size_t{128} << 20U;
constexpr std::size_t margin = std::size_t{8} << 20U;  // for what is beside them
constexpr int most_threads = 64;                       // that OpenBLAS is sure to be built for

bool can_be_mapped(std::size_t bytes) {
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory != MAP_FAILED && munmap(memory, bytes) == 0;
}

}  // namespace

void reserve_blas_memory() {
  static std::mutex one_at_a_time;
  static int reserved = 0;
  const std::lock_guard lock(one_at_a_time);
  const int wanted = std::min(worker_count(), most_threads);
  if (wanted <= reserved) {
    return;
  }
  const int missing = wanted - reserved;
  if (!can_be_mapped(missing * bytes_per_thread + margin)) {
    throw OutOfMemory(fmt::format(
        "factoring needs {} MB of address space for each of {} threads, which the system does not "
        "give: use fewer (--threads 1) or raise the limit (ulimit -v)",
        bytes_per_thread >> 20U, wanted));
  }
  // All at once, or they would be the same one.
  std::array<void*, most_threads> memory{};
  for (int i = 0; i < wanted; ++i) {
    memory[i] = blas_memory_alloc(0);
  }
  std::for_each_n(memory.begin(), wanted, blas_memory_free);
  reserved = wanted;
}

}  // namespace ibmfair
