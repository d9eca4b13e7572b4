#include "ibmfair/fill/hole_triangulation.h"

#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>

namespace ibmfair {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// Corner numbers of a triangle, as CGAL makes them.
struct Corners {
  Corners(int i, int j, int k) : index{i, j, k} {}
  int index[3];
};

/// Longer polygons than this, where the Delaunay triangulation has no solution, would take the
/// cubic algorithm minutes.
constexpr Eigen::Index longest_cubic = 400;

/// Closed by its first point. CGAL would do so itself, but for a polygon whose first and last
/// corner happen to lie at one place.
std::vector<Point> closed_points(const Points& X) {
  std::vector<Point> result;
  for (const auto x : X.rowwise()) {
    result.emplace_back(x[0], x[1], x[2]);
  }
  result.push_back(result.front());
  return result;
}

}  // namespace

Triangles triangulate_hole(const Points& loop, const Points& apex) {
  // The Delaunay triangulation shuffles its points, and where they lie on a sphere the order
  // decides: by default the seed is the time, and every thread goes on from its last hole.
  CGAL::get_default_random() = CGAL::Random(0);
  std::vector<Corners> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
      closed_points(loop), closed_points(apex), std::back_inserter(found),
      CGAL::parameters::use_delaunay_triangulation(true).do_not_use_cubic_algorithm(loop.rows() >
                                                                                    longest_cubic));
  Triangles F(static_cast<Eigen::Index>(found.size()), 3);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      F(t, i) = found[static_cast<std::size_t>(t)].index[i];
    }
  }
  return F;
}

}  // namespace ibmfair
