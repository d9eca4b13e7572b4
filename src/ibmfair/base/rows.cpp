#include "ibmfair/base/rows.h"

#include <algorithm>
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
  Rows rows;
  rows.first.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const Index v : values) {
    if (v >= 0) ++rows.first[static_cast<std::size_t>(v) + 1];
  }
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.value.resize(static_cast<std::size_t>(rows.first.back()));
  std::vector<std::int64_t> next(rows.first.begin(), rows.first.end() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= 0) rows.value[next[values[i]]++] = static_cast<Index>(i);
  }
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
