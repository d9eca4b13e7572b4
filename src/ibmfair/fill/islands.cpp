#include "ibmfair/fill/islands.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/fill/patch_bound.h"
#include "ibmfair/mesh/box_grid.h"

namespace ibmfair {
namespace {

constexpr double least_cosine = 0.5;  // between the directions that an island and its hole face
// An island may be this far from the expected surface, relative to its distance from the rim.
constexpr double most_offset = 0.4;

/// A loop with the area vector of a patch that fills it.
struct Outline {
  Points X;
  Vec3 middle, area;

  Outline(const Points& mesh, const Hole& hole) : X(mesh(hole.loop, Eigen::all)) {
    middle = X.colwise().mean();
    area.setZero();
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const Vec3 a = X.row(i), b = X.row((i + 1) % X.rows());
      area -= (a - middle).cross(b - middle) / 2;  // the mesh, not the patch, is to the left
    }
  }

  /// Whether a point lies inside the loop, seen along the area vector.
  bool surrounds(const Vec3& x) const {
    double angle = 0;
    const Vec3 n = area.normalized();
    const auto seen = [&](Eigen::Index i) {
      const Vec3 d = X.row(i).transpose() - x;
      return Vec3(d - n * n.dot(d));
    };
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const Vec3 a = seen(i), b = seen((i + 1) % X.rows());
      angle += std::atan2(n.dot(a.cross(b)), a.dot(b));
    }
    return std::abs(angle) > 3;  // 0 outside, 2 pi inside
  }
};

/// Whether the island's rim lies near the surface that is expected in the hole: the sphere that
/// fits the rim, or its plane.
bool is_near_expected(const Points& X, const Topology& topology, const Hole& hole,
                      const Outline& outer, const Outline& island) {
  std::optional<RimSphere> sphere;
  try {
    sphere = fit_rim_sphere(cut_patch(X, topology, {{hole.loop}}));
  } catch (const BadMesh&) {
    return false;
  }
  double offset = 0, gap = 0;
  for (const auto row : island.X.rowwise()) {
    const Vec3 x = row;
    offset += sphere ? std::abs((x - sphere->center).norm() - sphere->radius)
                     : std::abs((x - outer.middle).dot(outer.area.normalized()));
    gap += std::sqrt((outer.X.rowwise() - row).rowwise().squaredNorm().minCoeff());
  }
  return offset <= most_offset * gap;
}

bool may_surround(const Hole& hole, const Hole& island) {
  return hole.component != island.component && hole.closed && hole.simple && island.closed &&
         island.simple && island.border_share > 0 && hole.diameter > island.diameter;
}

bool is_island(const Points& X, const Topology& topology, const Hole& hole, const Hole& island,
               const Outline& outer, const Outline& inner) {
  return may_surround(hole, island) &&
         -outer.area.dot(inner.area) > least_cosine * outer.area.norm() * inner.area.norm() &&
         std::ranges::all_of(inner.X.rowwise(),
                             [&](const auto& x) { return outer.surrounds(x.transpose()); }) &&
         is_near_expected(X, topology, hole, outer, inner);
}

}  // namespace

std::vector<Index> surrounding_holes(const Points& X, const Topology& topology,
                                     const std::vector<Hole>& holes) {
  std::vector<Index> result(holes.size(), -1), islands(holes.size(), 0);
  if (topology.component_count < 2) {
    return result;
  }
  std::vector<Outline> outlines;
  for (const Hole& hole : holes) {
    outlines.emplace_back(X, hole);
  }
  std::vector<BoxGrid::Box> boxes;
  for (const Outline& outline : outlines) {
    boxes.emplace_back(outline.X.colwise().minCoeff().transpose(),
                       outline.X.colwise().maxCoeff().transpose());
  }
  const BoxGrid grid(boxes);
  std::vector<Index> near;
  for (const Hole& hole : holes) {
    const Vec3 bulge = Vec3::Constant(hole.diameter / 2);  // the surface may rise above its rim
    grid.find({boxes[hole.id].min() - bulge, boxes[hole.id].max() + bulge}, near);
    for (const Index other : near) {
      if (is_island(X, topology, hole, holes[other], outlines[hole.id], outlines[other])) {
        result[other] = hole.id;
        ++islands[hole.id];
      }
    }
  }
  for (Index& hole : result) {
    hole = hole >= 0 && islands[hole] == 1 && result[hole] < 0 ? hole : -1;
  }
  return result;
}

}  // namespace ibmfair
