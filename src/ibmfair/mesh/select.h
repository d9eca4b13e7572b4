// Choosing elements by a test that runs on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The i in 0 .. count - 1 for which holds(i), in increasing order. Tests run in parallel: they may
/// not write where another reads.
template <class Test>
std::vector<Index> indices_where(Eigen::Index count, Test&& holds) {
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count));
  parallel_for(count, [&](std::int64_t i) { chosen[i] = holds(static_cast<Index>(i)) ? 1 : 0; });
  std::vector<Index> indices;
  indices.reserve(static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), 1)));
  for (Index i = 0; i < static_cast<Index>(count); ++i) {
    if (chosen[i]) {
      indices.push_back(i);
    }
  }
  return indices;
}

}  // namespace ibmfair
