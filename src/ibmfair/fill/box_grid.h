// Finds triangles by their bounding boxes.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Boxes hashed by the cells of a regular grid that they touch.
class BoxGrid {
 public:
  using Box = Eigen::AlignedBox3d;

  explicit BoxGrid(std::vector<Box> boxes);

  /// Puts the numbers of the boxes that touch `box` into `found`, sorted.
  void find(const Box& box, std::vector<Index>& found) const;

 private:
  using Cell = Eigen::Array<std::int64_t, 3, 1>;

  Cell cell(const Vec3& x) const;
  template <class Visit>
  void each_cell(const Box& box, const Visit& visit) const;

  std::vector<Box> boxes_;
  Box all_;
  double size_ = 1;  // of a cell
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
  std::vector<std::uint8_t>
      maybe_;  // by a hash of the cell: false where the cell is empty for sure
};

}  // namespace ibmfair
