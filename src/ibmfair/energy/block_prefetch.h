// Computing a block while the memory for what follows is on its way. Positions are read, and
// gradients written, in the order of the mesh's vertices, which need not be that of the block: they
// come from memory one cache line at a time. Where they were asked for all at once, before they are
// used, a fourth of the time of a gradient went into waiting. Each had better have a pass over the
// block of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// What is fetched while a block is computed, where given: positions (#V x 3) for the block after
/// it, and the places of the block's own vertices in the gradient (#V x 3).
struct BlockPrefetch {
  const Points* X = nullptr;
  const Points* G = nullptr;
};

namespace block_prefetch_detail {

/// Asks for cache lines of rows, an equal part of them in each of some steps.
class Walk {
 public:
  Walk() = default;
  Walk(const Points& rows, std::span<const Index> lines, std::int64_t steps)
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

}  // namespace block_prefetch_detail

/// Calls compute(first, groups) for a few of the groups 0 .. all_groups - 1 of a block at a time.
template <class Compute>
void compute_and_prefetch(const MeshBlocks& blocks, const MeshBlock& b, std::int64_t all_groups,
                          const BlockPrefetch& wanted, const Compute& compute) {
  using block_prefetch_detail::Walk;
  constexpr std::int64_t few = 2;  // of many lines at once some would be forgotten
  const std::int64_t steps = (all_groups + few - 1) / few;
  Walk results, positions;
  if (wanted.G != nullptr) {
    results = Walk(*wanted.G, b.own_lines(), steps);
  }
  if (wanted.X != nullptr && &b != &blocks.block.back()) {
    const MeshBlock& next = *(&b + 1);  // most likely the next one of this thread, too
    positions = Walk(*wanted.X, next.lines, steps);
  }
  for (std::int64_t first = 0; first < all_groups; first += few) {
    compute(first, std::min(few, all_groups - first));
    results.step();
    positions.step();
  }
}

}  // namespace ibmfair
