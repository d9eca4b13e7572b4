#include "ibmfair/base/compressed_rows.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/sort_into_rows.h"

namespace ibmfair {

CompressedRows positions_by_value(std::span<const Index> values, Index count) {
  if (values.size() > std::numeric_limits<Index>::max()) {
    throw BadMesh("the mesh is too large: " + std::to_string(values.size()) +
                  " entries, more than can be numbered");
  }
  return sort_into_rows(count, std::ssize(values), [&](const auto& put) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      put(values[i], static_cast<Index>(i));
    }
  });
}

std::vector<Index> row_of_position(const CompressedRows& rows) {
  std::vector<Index> row(rows.value.size());
  parallel_for(rows.size(), [&](std::int64_t i) {
    std::fill(row.begin() + rows.first[i], row.begin() + rows.first[i + 1], static_cast<Index>(i));
  });
  return row;
}

}  // namespace ibmfair
