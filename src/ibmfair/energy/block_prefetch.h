// Prefetches memory while a block is computed. Positions are read and gradients are written in the
// order of the mesh's vertices, which need not be the order of the block, so they are loaded one
// cache line at a time. Prefetching all lines at once just before use left a quarter of the time of
// a gradient evaluation waiting for memory, and of a hundred prefetches issued at once the
// processor drops some. The prefetches are therefore spread over a pass.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Number of doubles in a cache line.
inline constexpr Index numbers_per_line = 64 / sizeof(double);

/// Prefetches the given cache lines of `rows`, an equal share of them in each of `steps` calls of
/// step(). Each object should be used in a pass over a block of its own.
class BlockPrefetch {
 public:
  BlockPrefetch() = default;
  BlockPrefetch(const Points& rows, std::span<const Index> lines, std::int64_t steps)
      : rows_(rows.data()), lines_(lines), part_((lines.size() + steps - 1) / steps) {}

  void step() {
    const std::size_t part = std::min(part_, lines_.size());
    for (const Index line : lines_.first(part)) {
      // Into the second-level cache: the first level is too small.
      __builtin_prefetch(rows_ + numbers_per_line * std::ptrdiff_t{line}, 0, 2);
    }
    lines_ = lines_.subspan(part);
  }

 private:
  const double* rows_ = nullptr;
  std::span<const Index> lines_;
  std::size_t part_ = 0;
};

}  // namespace ibmfair
