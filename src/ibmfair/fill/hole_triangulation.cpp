#include "ibmfair/fill/hole_triangulation.h"

#include <cstddef>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Has_timestamp.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>

namespace ibmfair {

/// As Exact_predicates_inexact_constructions_kernel, under a name of its own.
class HoleKernel
    : public CGAL::Filtered_kernel_adaptor<
          CGAL::Type_equality_wrapper<CGAL::Simple_cartesian<double>::Base<HoleKernel>::Type,
                                      HoleKernel>,
          true> {};

}  // namespace ibmfair

namespace CGAL {

/// CGAL goes around an edge from the least of its cells, and of two triangulations of a hole that
/// are equally good takes the one that it comes upon first. Cells without a time stamp are compared
/// by their addresses, which depend on all that was allocated before.
template <class Cell>
class Delaunay_triangulation_cell_base_3<ibmfair::HoleKernel, Cell> : public Cell {
 public:
  using Has_timestamp = Tag_true;
  template <class Triangulation>
  struct Rebind_TDS {
    using Other = Delaunay_triangulation_cell_base_3<
        ibmfair::HoleKernel, typename Cell::template Rebind_TDS<Triangulation>::Other>;
  };

  using Cell::Cell;
  std::size_t time_stamp() const { return time_stamp_; }
  void set_time_stamp(std::size_t stamp) { time_stamp_ = stamp; }

 private:
  std::size_t time_stamp_ = static_cast<std::size_t>(-1);
};

}  // namespace CGAL

namespace ibmfair {
namespace {

using Point = HoleKernel::Point_3;

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
