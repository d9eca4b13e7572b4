// Finds triangles by their bounding boxes.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// Boxes hashed by the cells of a regular grid that they touch. Cells with the same hash share a
/// slot: a query then compares a few more boxes, but need not compare the numbers of the cells.
class BoxGrid {
 public:
  using Box = Eigen::AlignedBox3d;

  explicit BoxGrid(std::vector<Box> boxes);

  /// Writes the numbers of the boxes that touch `box` to `found`, sorted.
  void find(const Box& box, std::vector<Index>& found) const;

 private:
  using Cell = Eigen::Array<std::int64_t, 3, 1>;

  Cell cell(const Vec3& x) const;
  template <class Visit>
  void each_slot(const Box& box, const Visit& visit) const;

  std::vector<Box> boxes_;
  Box all_;
  double size_ = 1;  // of a cell
  int hash_bits_ = 1;
  CompressedRows slots_;  // of boxes
};

}  // namespace ibmfair
