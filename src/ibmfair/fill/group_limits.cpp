#include "ibmfair/fill/group_limits.h"

#include <algorithm>
#include <cmath>

namespace ibmfair {
namespace {

// The most vertices of a patch: for a hole of n edges, or for an area that needs m vertices.
constexpr double least_vertices = 64;
constexpr double vertices_per_squared_edge = 0.5;
constexpr double vertices_per_needed = 2;

/// The number of vertices of even triangles that cover an area, with edges as long as those of the
/// rim or as `inner_spacing`.
double vertices_needed(const Patch& patch, double area) {
  if (patch.inner_spacing > 0) {
    return area / (patch.inner_spacing * patch.inner_spacing) / (std::sqrt(3.0) / 2);
  }
  double per_squared_length = 0;
  for (const RimEdge& edge : patch.rim) {
    per_squared_length += 1 / (patch.X.row(edge.a) - patch.X.row(edge.b)).squaredNorm();
  }
  return area * per_squared_length / static_cast<double>(patch.rim.size()) / (std::sqrt(3.0) / 2);
}

}  // namespace

PatchLimits limits_of(const FilledGroup& group, const std::vector<Index>& bridges,
                      const FillOptions& options) {
  const Patch& plain = *group.plain;
  PatchLimits limits{group.most_vertices, bound_of(plain)};
  const double edges = std::max(static_cast<double>(plain.rim.size()), edges_along_rim(plain));
  double most = least_vertices + vertices_per_squared_edge * edges * edges;
  limits.tube = std::ranges::any_of(group.holes, [&](Index h) { return bridges[h] >= 0; });
  if (options.continuity == Continuity::curvature && group.holes.size() == 1 && plain.one_disc &&
      options.rim_smooth == 0) {
    if (const auto sphere = fit_rim_sphere(plain); sphere && sphere->is_deep()) {
      limits.start = sphere;
      most = std::max(most, vertices_per_needed * vertices_needed(plain, sphere->missing_area()));
    }
  }
  if (options.most_new_vertices > 0) {  // more than this not even the largest patch needs
    most = std::max(most, vertices_per_needed * vertices_needed(plain, limits.bound.area));
  }
  if (most < limits.most_vertices) {
    limits.most_vertices = static_cast<Index>(most);
  }
  return limits;
}

}  // namespace ibmfair
