// Lists of lists of numbers: the vertices of each stencil, the triangles of each vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// A flat list of short lists: item i holds value[first[i]] .. value[first[i + 1] - 1].
struct CompressedRows {
  /// This constructor keeps CompressedRows from being an aggregate. If CompressedRows were one and
  /// the allocation of `first` failed while a `{}` initialises an enclosing object, GCC 12 would
  /// destroy the object's preceding members twice.
  CompressedRows() = default;

  std::vector<std::int64_t> first{0};
  std::vector<Index> value;

  Index size() const { return static_cast<Index>(first.size()) - 1; }
  std::span<const Index> operator[](Index i) const {
    return {value.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

/// Sorts the positions in `values` by value: row v, 0 <= v < count, lists the positions at which v
/// stands in `values`, in increasing order. Negative values belong to no row. Throws BadMesh if
/// there are more values than Index can number.
CompressedRows positions_by_value(std::span<const Index> values, Index count);

/// For each position in `rows.value`, the number of the row that contains the position.
std::vector<Index> row_of_position(const CompressedRows& rows);

}  // namespace ibmfair
