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

/// To the second cache: the first is small.
inline void fetch(const Points& rows, Index v) {
  __builtin_prefetch(rows.data() + 3 * std::ptrdiff_t{v}, 0, 2);
}

/// A list of which as large a share is done as of the groups.
struct Walk {
  std::span<const Index> list;
  std::size_t done = 0;

  template <class Take>
  void advance(std::int64_t groups, std::int64_t all_groups, const Take& take) {
    const std::size_t end = list.size() * static_cast<std::size_t>(groups) / all_groups;
    for (; done < end; ++done) {
      take(list[done]);
    }
  }
};

}  // namespace block_prefetch_detail

/// Calls compute(first, groups) for a few of the groups 0 .. all_groups - 1 of a block at a time.
template <class Compute>
void compute_and_prefetch(const MeshBlocks& blocks, const MeshBlock& b, std::int64_t all_groups,
                          const BlockPrefetch& wanted, const Compute& compute) {
  using block_prefetch_detail::fetch;
  constexpr std::int64_t few = 8;
  block_prefetch_detail::Walk results{blocks.owned_of(b)}, own, halo;
  if (wanted.X != nullptr && &b != &blocks.block.back()) {
    const MeshBlock& next = *(&b + 1);  // most likely the next one of this thread, too
    own.list = blocks.owned_of(next);
    halo.list = next.halo;
  }
  for (std::int64_t first = 0; first < all_groups; first += few) {
    const std::int64_t end = std::min(first + few, all_groups);
    compute(first, end - first);
    if (wanted.G != nullptr) {
      results.advance(end, all_groups, [&](Index v) { fetch(*wanted.G, v); });
    }
    own.advance(end, all_groups, [&](Index v) { fetch(*wanted.X, v); });
    halo.advance(end, all_groups, [&](Index v) { fetch(*wanted.X, v); });
  }
}

}  // namespace ibmfair
