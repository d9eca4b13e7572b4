#include "ibmfair/fill/intersections.h"

#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/box_grid.h"

namespace ibmfair {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Points& X, Index v) {
  return {X(v, 0), X(v, 1), X(v, 2)};
}

/// A triangle with its corners rotated, so that the corner number `from` comes first.
struct Turned {
  Kernel::Triangle_3 triangle;
  Kernel::Segment_3 opposite;  // the edge opposite to the first corner

  Turned(const Points& X, const Triangles& F, Index t, int from)
      : triangle(point(X, F(t, from)), point(X, F(t, (from + 1) % 3)),
                 point(X, F(t, (from + 2) % 3))),
        opposite(triangle[1], triangle[2]) {}
};

bool intersect(const Points& X, const Triangles& F, Index t, Index u) {
  int shared = 0, place_t = 0, place_u = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // Vertices with equal coordinates count as one: the two sides of a cut in the mesh touch.
      if (F(t, i) == F(u, j) || X.row(F(t, i)) == X.row(F(u, j))) {
        ++shared;
        place_t = i;
        place_u = j;
      }
    }
  }
  if (shared > 1) {
    return false;
  }
  const Turned a(X, F, t, place_t), b(X, F, u, place_u);
  if (a.triangle.is_degenerate() || b.triangle.is_degenerate()) {
    return false;
  }
  if (shared == 1) {  // any further common point implies one on an edge opposite to the corner
    return CGAL::do_intersect(a.opposite, b.triangle) || CGAL::do_intersect(b.opposite, a.triangle);
  }
  return CGAL::do_intersect(a.triangle, b.triangle);
}

BoxGrid::Box box(const Points& X, const Triangles& F, Index t) {
  BoxGrid::Box result;
  for (int i = 0; i < 3; ++i) {
    result.extend(X.row(F(t, i)).transpose());
  }
  return result;
}

}  // namespace

std::vector<std::array<Index, 2>> patch_intersections(const Points& X, const Triangles& F,
                                                      Index patch_from) {
  std::vector<BoxGrid::Box> boxes;
  for (auto t = patch_from; t < F.rows(); ++t) {
    boxes.push_back(box(X, F, t));
  }
  const BoxGrid grid(std::move(boxes));
  // In blocks, so that threads share the work and the order of the pairs does not depend on them.
  constexpr Index block = 4096;
  std::vector<std::vector<std::array<Index, 2>>> found((F.rows() + block - 1) / block);
  parallel_tasks(static_cast<std::int64_t>(found.size()), [&](std::int64_t b) {
    std::vector<Index> near;
    const Index first = static_cast<Index>(b) * block;
    for (Index t = first; t < std::min<Eigen::Index>(F.rows(), first + block); ++t) {
      grid.find(box(X, F, t), near);
      for (const Index i : near) {
        const Index u = patch_from + i;
        if (u > t && intersect(X, F, t, u)) {
          found[b].push_back({t, u});
        }
      }
    }
  });
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& part : found) {
    pairs.insert(pairs.end(), part.begin(), part.end());
  }
  return pairs;
}

}  // namespace ibmfair
