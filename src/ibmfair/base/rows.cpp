#include "ibmfair/base/rows.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"

namespace ibmfair {

Rows positions_by_value(std::span<const Index> values, Index count) {
  if (values.size() > std::numeric_limits<Index>::max()) {
    throw BadMesh("the mesh is too large: " + std::to_string(values.size()) +
                  " entries, more than can be numbered");
  }
  const auto each = [&](const auto& act) {
    parallel_ranges(count, std::ssize(values), [&](std::int64_t first, std::int64_t last) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= first && values[i] < last) {
          act(static_cast<std::size_t>(values[i]), static_cast<Index>(i));
        }
      }
    });
  };
  Rows rows;
  rows.first.assign(static_cast<std::size_t>(count) + 1, 0);
  each([&](std::size_t v, Index) { ++rows.first[v + 1]; });
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.value.resize(static_cast<std::size_t>(rows.first.back()));
  std::vector<std::int64_t> next(rows.first.begin(), rows.first.end() - 1);
  each([&](std::size_t v, Index i) { rows.value[next[v]++] = i; });
  return rows;
}

std::vector<Index> row_of_position(const Rows& rows) {
  std::vector<Index> row(rows.value.size());
  parallel_for(rows.size(), [&](std::int64_t i) {
    std::fill(row.begin() + rows.first[i], row.begin() + rows.first[i + 1], static_cast<Index>(i));
  });
  return row;
}

}  // namespace ibmfair
