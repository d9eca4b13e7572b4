// Lists of lists of numbers: the vertices of each stencil, the triangles of each vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A flat list of short lists: item i holds value[first[i]] .. value[first[i + 1] - 1].
struct Rows {
  /// No aggregate: where its list finds no memory in a `{}` of what holds it, GCC 12 destroys the
  /// members before it twice.
  Rows() = default;

  std::vector<std::int64_t> first{0};
  std::vector<Index> value;

  Index size() const { return static_cast<Index>(first.size()) - 1; }
  std::span<const Index> operator[](Index i) const {
    return {value.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

/// Row v, of 0 .. count - 1: where v stands in `values`, in increasing order. Negative values are
/// in no row. Throws BadMesh where there are more values than Index can number.
Rows positions_by_value(std::span<const Index> values, Index count);

/// For each position in `rows.value` the row that it belongs to.
std::vector<Index> row_of_position(const Rows& rows);

}  // namespace ibmfair
