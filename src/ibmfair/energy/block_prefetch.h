// Memory that is on its way while a block is computed. Positions are read, and gradients written,
// in the order of the mesh's vertices, which need not be that of the block: they come from memory
// one cache line at a time. Where they were asked for all at once, before they are used, a fourth
// of the time of a gradient went into waiting; and of a hundred asked for at once some are dropped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Numbers in a line of a cache.
inline constexpr Index numbers_per_line = 64 / sizeof(double);

/// Asks for lines of rows, an equal part of them in each of some steps. Each had better have a pass
/// over a block of its own.
class BlockPrefetch {
 public:
  BlockPrefetch() = default;
  BlockPrefetch(const Points& rows, std::span<const Index> lines, std::int64_t steps)
      : rows_(rows.data()), lines_(lines), part_((lines.size() + steps - 1) / steps) {}

  void step() {
    const std::size_t part = std::min(part_, lines_.size());
    for (const Index line : lines_.first(part)) {
      // To the second cache: the first is small.
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
