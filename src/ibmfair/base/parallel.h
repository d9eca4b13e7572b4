// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "ibmfair/base/threads.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// Loops with fewer iterations than this run on one thread, because waking other threads would take
/// longer.
inline constexpr std::int64_t worth_sharing = 16384;

/// Calls task(i) for every i in 0 .. count - 1, each on any thread. Two tasks must not write to the
/// same memory. An exception that a task throws is rethrown here. If other programs keep a thread
/// from running, only the task on that thread is delayed.
void parallel_tasks(std::int64_t count, const std::function<void(std::int64_t)>& task);

/// Calls `parallel_tasks` if `share` is true; otherwise runs all tasks on the calling thread.
template <class Task>
void run_tasks(std::int64_t count, bool share, const Task& task) {
  if (share) {
    parallel_tasks(count, std::cref(task));
    return;
  }
  for (std::int64_t i = 0; i < count; ++i) {
    task(i);
  }
}

/// Calls body(first, last) in parallel for blocks of 0 .. count - 1. Two calls must not write to
/// the same memory.
template <class Body>
void parallel_blocks(std::int64_t count, Body&& body) {
  constexpr std::int64_t block = 2048;
  run_tasks((count + block - 1) / block, count >= worth_sharing,
            [&](std::int64_t b) { body(b * block, std::min(count, (b + 1) * block)); });
}

/// Calls body(i) in parallel for every i in 0 .. count - 1. Two calls must not write to the same
/// memory.
template <class Body>
void parallel_for(std::int64_t count, Body&& body) {
  parallel_blocks(count, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      body(i);
    }
  });
}

/// Splits 0 .. count - 1 into ranges and calls body(first, last) for each. There is one range for
/// each of at most 8 threads if the `work` (the number of loop iterations in one body) is worth
/// sharing, else a single range. Used for sorting into rows: every body goes through all items and
/// takes those that belong to its own rows, so that each row receives its items in order.
template <class Body>
void parallel_ranges(std::int64_t count, std::int64_t work, const Body& body) {
  const bool share = work >= worth_sharing;
  constexpr std::int64_t few = 8;
  const std::int64_t ranges = share ? std::min(few, static_cast<std::int64_t>(worker_count())) : 1;
  run_tasks(ranges, share,
            [&](std::int64_t i) { body(count * i / ranges, count * (i + 1) / ranges); });
}

/// Calls task(first, last, scratch) in parallel on parts of 0 .. count - 1 with `part_size` numbers
/// each. `scratch` is a vector of at least `scratch_size` entries, which hold zeros or the values
/// that earlier tasks of this loop on the same thread have left.
template <class Entry, class Task>
void parallel_parts(std::int64_t count, std::int64_t part_size, std::size_t scratch_size,
                    const Task& task) {
  // Space between the scratch memory of two threads: if both wrote to one cache line, each would
  // slow the other down.
  constexpr std::size_t cache_line = 64;
  const std::size_t size = scratch_size + cache_line / sizeof(Entry);
  std::vector<std::vector<Entry>> scratch(worker_count());
  run_tasks((count + part_size - 1) / part_size, count >= worth_sharing, [&](std::int64_t part) {
    auto& own = scratch[worker_index()];
    own.resize(size, 0);
    task(part * part_size, std::min(count, (part + 1) * part_size), own);
  });
}

/// The number of terms in each block of a sum, except in the last block.
inline constexpr std::int64_t sum_block = 1024;

/// `zero` plus the sum of body(first, last) over blocks of 0 .. count - 1. The blocks have a fixed
/// size and are added in order, so the rounding errors are the same for any number of threads.
template <class Value, class Body>
Value parallel_block_sum(std::int64_t count, const Value& zero, Body&& body) {
  const std::int64_t blocks = (count + sum_block - 1) / sum_block;
  std::vector<Value> partial(static_cast<std::size_t>(blocks), zero);
  run_tasks(blocks, count >= worth_sharing, [&](std::int64_t b) {
    partial[static_cast<std::size_t>(b)] =
        body(b * sum_block, std::min(count, (b + 1) * sum_block));
  });
  Value sum = zero;
  for (const Value& part : partial) {
    sum += part;
  }
  return sum;
}

/// The sum of body(i) over 0 .. count - 1, added up in the same order for any number of threads.
template <class Value, class Body>
Value parallel_sum(std::int64_t count, const Value& zero, Body&& body) {
  return parallel_block_sum(count, zero, [&](std::int64_t first, std::int64_t last) {
    Value sum = zero;
    for (std::int64_t i = first; i < last; ++i) {
      sum += body(i);
    }
    return sum;
  });
}

/// As above, for plain numbers.
template <class Body>
double parallel_sum(std::int64_t count, Body&& body) {
  return parallel_sum(count, 0.0, body);
}

}  // namespace ibmfair
