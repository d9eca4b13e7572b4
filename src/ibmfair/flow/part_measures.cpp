#include "ibmfair/flow/part_measures.h"

#include <algorithm>
#include <limits>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

double own_share(std::span<const Index> vertices, const MeshParts& parts) {
  const auto own = std::count_if(vertices.begin(), vertices.end(),
                                 [&parts](Index v) { return parts.owns_vertex(v); });
  return static_cast<double>(own) / static_cast<double>(vertices.size());
}

double mean_edge_length(const Points& X, const Topology& topology, const MeshParts& parts) {
  if (parts.is_whole()) {
    return mean_edge_length(X, topology.E);
  }
  const Eigen::Array2d sums =
      parallel_sum(topology.E.rows(), Eigen::Array2d(Eigen::Array2d::Zero()), [&](std::int64_t e) {
        const auto x = topology.E.row(e);
        const double share = own_share({x.data(), 2}, parts);
        return Eigen::Array2d(share * (X.row(x[1]) - X.row(x[0])).norm(), share);
      });
  const double length = parts.sum(sums[0]), count = parts.sum(sums[1]);
  return count > 0 ? length / count : 0;
}

double diagonal(const Points& X, const MeshParts& parts) {
  if (parts.is_whole()) {
    return bounding_box_size(X).norm();
  }
  constexpr double lowest = std::numeric_limits<double>::lowest();
  Vec3 size = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    const double largest = parts.max(X.rows() > 0 ? X.col(c).maxCoeff() : lowest);
    const double smallest = -parts.max(X.rows() > 0 ? -X.col(c).minCoeff() : lowest);
    size[c] = std::max(0.0, largest - smallest);
  }
  return size.norm();
}

double surface_area(const Points& X, const Topology& topology, const MeshParts& parts) {
  if (parts.is_whole()) {
    return surface_area(X, topology.F);
  }
  return parts.sum(parallel_sum(topology.F.rows(), [&](std::int64_t t) {
    return parts.owns_triangle(static_cast<Index>(t))
               ? double_area_vector(X, topology.F, t).norm() / 2
               : 0;
  }));
}

}  // namespace ibmfair
