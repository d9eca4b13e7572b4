// Selects elements by a test that runs on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The numbers i in 0 .. count - 1 for which holds(i) is true, in increasing order. The calls run
/// in parallel, so holds() must not write to memory that another call reads.
template <class Test>
std::vector<Index> indices_where(Eigen::Index count, Test&& holds) {
  constexpr std::int64_t block = 8192;
  const std::int64_t blocks = (count + block - 1) / block;
  const bool share = count >= worth_sharing;
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count));
  // The start of each block in the list of results.
  std::vector<std::int64_t> first(static_cast<std::size_t>(blocks) + 1, 0);
  run_tasks(blocks, share, [&](std::int64_t b) {
    const std::int64_t end = std::min<std::int64_t>(count, (b + 1) * block);
    std::int64_t found = 0;
    for (std::int64_t i = b * block; i < end; ++i) {
      chosen[i] = holds(static_cast<Index>(i)) ? 1 : 0;
      found += chosen[i];
    }
    first[b + 1] = found;
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Index> indices(static_cast<std::size_t>(first.back()));
  run_tasks(blocks, share && !indices.empty(), [&](std::int64_t b) {
    std::int64_t i = b * block;
    for (std::int64_t k = first[b]; k < first[b + 1]; ++i) {
      if (chosen[i] != 0) {
        indices[k++] = static_cast<Index>(i);
      }
    }
  });
  return indices;
}

}  // namespace ibmfair
