// A counting sort on several threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/parallel.h"

namespace ibmfair {

/// Rows 0 .. count - 1, each with its values in the order in which `each` passes them. `each(put)`
/// must call put(row, value) for every value, about `work` of them, in the same way each time it is
/// called. Values for rows outside 0 .. count - 1 are dropped.
template <class Each>
CompressedRows sort_into_rows(Index count, std::int64_t work, const Each& each) {
  const auto for_own_rows = [&](const auto& take) {
    parallel_ranges(count, work, [&](std::int64_t first, std::int64_t last) {
      each([&](std::int64_t row, Index value) {
        if (row >= first && row < last) take(static_cast<std::size_t>(row), value);
      });
    });
  };
  CompressedRows rows;
  rows.first.assign(static_cast<std::size_t>(count) + 1, 0);
  for_own_rows([&](std::size_t row, Index /*value*/) { ++rows.first[row + 1]; });
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.value.resize(static_cast<std::size_t>(rows.first.back()));
  std::vector<std::int64_t> next(rows.first.begin(), rows.first.end() - 1);
  for_own_rows([&](std::size_t row, Index value) { rows.value[next[row]++] = value; });
  return rows;
}

}  // namespace ibmfair
