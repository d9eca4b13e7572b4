#include "ibmfair/flow/mesh_parts.h"

#include <algorithm>

namespace ibmfair {

MeshParts::MeshParts(Index own, Index vertices, std::vector<std::uint8_t> own_triangles)
    : is_whole_(false),
      own_vertices_(static_cast<std::size_t>(vertices), 0),
      own_triangles_(std::move(own_triangles)) {
  std::fill_n(own_vertices_.begin(), own, 1);
}

const MeshParts& MeshParts::one() {
  static const MeshParts whole;
  return whole;
}

void MeshParts::refresh(std::vector<std::uint8_t>& flags) const {
  if (is_whole()) {
    return;
  }
  Points rows = Points::Zero(static_cast<Eigen::Index>(flags.size()), 3);
  for (std::size_t v = 0; v < flags.size(); ++v) {
    rows(static_cast<Eigen::Index>(v), 0) = flags[v];
  }
  refresh(rows);
  for (std::size_t v = 0; v < flags.size(); ++v) {
    flags[v] = static_cast<std::uint8_t>(rows(static_cast<Eigen::Index>(v), 0));
  }
}

}  // namespace ibmfair
