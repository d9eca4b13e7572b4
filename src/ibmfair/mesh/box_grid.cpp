#include "ibmfair/mesh/box_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ibmfair {
namespace {

constexpr double cells_along_longest = 1 << 20;  // cell numbers fit into 21 bits per axis
constexpr std::size_t slots_per_box = 2;

/// Multiplicative hashing (Knuth 6.4): the upper bits of the product depend on all bits of the
/// cell.
std::uint64_t mixed(std::int64_t x, std::int64_t y, std::int64_t z) {
  const std::uint64_t key = static_cast<std::uint64_t>(x) << 42 |
                            static_cast<std::uint64_t>(y) << 21 | static_cast<std::uint64_t>(z);
  return key * 0x9E3779B97F4A7C15U;
}

}  // namespace

BoxGrid::BoxGrid(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) {
    return;
  }
  double sum = 0, largest = 0;
  for (const Box& box : boxes_) {
    all_.extend(box);
    sum += box.sizes().maxCoeff();
    largest = std::max(largest, box.sizes().maxCoeff());
  }
  // Cells are about two boxes wide, but the largest box touches at most a few thousand cells.
  size_ = std::max({2 * sum / static_cast<double>(boxes_.size()), largest / 16,
                    all_.sizes().maxCoeff() / cells_along_longest});
  size_ = size_ > 0 ? size_ : 1;
  hash_bits_ = static_cast<int>(std::bit_width(slots_per_box * boxes_.size()));
  std::vector<Index> slot, box;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    each_slot(boxes_[i], [&](Index s) {
      slot.push_back(s);
      box.push_back(static_cast<Index>(i));
    });
  }
  slots_ = positions_by_value(slot, Index{1} << hash_bits_);
  for (Index& entry : slots_.value) {
    entry = box[entry];
  }
}

/// `x` must lie within the bounding box of all boxes, so that truncation rounds down. If the
/// distance between boxes overflows, the cell size is infinite and there is a single cell.
BoxGrid::Cell BoxGrid::cell(const Vec3& x) const {
  if (!std::isfinite(size_)) {
    return Cell::Zero();
  }
  return ((x - all_.min()) / size_).array().cast<std::int64_t>();
}

template <class Visit>
void BoxGrid::each_slot(const Box& box, const Visit& visit) const {
  const Cell low = cell(box.min()), high = cell(box.max());
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        visit(static_cast<Index>(mixed(x, y, z) >> (64 - hash_bits_)));
      }
    }
  }
}

void BoxGrid::find(const Box& box, std::vector<Index>& found) const {
  found.clear();
  const Box inside = box.intersection(all_);
  if (boxes_.empty() || inside.isEmpty()) {
    return;
  }
  const Eigen::Array3d extent = ((inside.max() - inside.min()) / size_).array() + 1;
  if (extent.prod() > static_cast<double>(boxes_.size())) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].intersects(box)) {
        found.push_back(static_cast<Index>(i));
      }
    }
  } else {
    each_slot(inside, [&](Index s) {
      for (const Index i : slots_[s]) {
        if (boxes_[i].intersects(box)) {
          found.push_back(i);
        }
      }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
}

}  // namespace ibmfair
