#include "ibmfair/fill/box_grid.h"

#include <algorithm>

namespace ibmfair {
namespace {

constexpr double cells_along_longest = 1 << 20;  // numbers of cells fit into 21 bits an axis

std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return static_cast<std::uint64_t>(x) << 42 | static_cast<std::uint64_t>(y) << 21 |
         static_cast<std::uint64_t>(z);
}

/// Most boxes that are asked for touch empty cells only. A table of bytes that stays in the cache
/// says so without a look into the map.
constexpr int hash_bits = 18;

std::size_t short_hash(std::uint64_t key) {
  return (key * 0x9E3779B97F4A7C15U) >> (64 - hash_bits);
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
  // About the size of a box; the largest box must not touch more than some thousand cells.
  size_ = std::max({sum / static_cast<double>(boxes_.size()), largest / 16,
                    all_.sizes().maxCoeff() / cells_along_longest});
  size_ = size_ > 0 ? size_ : 1;
  maybe_.assign(std::size_t{1} << hash_bits, 0);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    each_cell(boxes_[i], [&](std::uint64_t k) {
      cells_[k].push_back(static_cast<Index>(i));
      maybe_[short_hash(k)] = 1;
    });
  }
}

BoxGrid::Cell BoxGrid::cell(const Vec3& x) const {
  return ((x - all_.min()) / size_).array().floor().cast<std::int64_t>();
}

template <class Visit>
void BoxGrid::each_cell(const Box& box, const Visit& visit) const {
  const Cell low = cell(box.min()), high = cell(box.max());
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        visit(key(x, y, z));
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
      found.push_back(static_cast<Index>(i));
    }
  } else {
    each_cell(inside, [&](std::uint64_t k) {
      if (maybe_[short_hash(k)] == 0) {
        return;
      }
      if (const auto it = cells_.find(k); it != cells_.end()) {
        found.insert(found.end(), it->second.begin(), it->second.end());
      }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  std::erase_if(found, [&](Index i) { return !boxes_[i].intersects(box); });
}

}  // namespace ibmfair
