#include "ibmfair/fill/hole_triangulation.h"

#include <cstddef>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Has_timestamp.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>

namespace ibmfair {

/// The same kernel as Exact_predicates_inexact_constructions_kernel, but a type of its own, so that
/// the specialization below applies to no other code.
class HoleKernel
    : public CGAL::Filtered_kernel_adaptor<
          CGAL::Type_equality_wrapper<CGAL::Simple_cartesian<double>::Base<HoleKernel>::Type,
                                      HoleKernel>,
          true> {};

}  // namespace ibmfair

namespace CGAL {

/// Cells with time stamps make the result deterministic. CGAL visits the cells around an edge from
/// the least cell on, and of two equally good triangulations of a hole takes the first that it
/// finds. Cells without time stamps are compared by their addresses, which depend on earlier
/// allocations.
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

/// CGAL's cubic algorithm, the fallback if the Delaunay triangulation has no solution, would take
/// minutes for polygons with more corners.
constexpr Eigen::Index longest_cubic = 400;

/// The points with the first point repeated at the end. CGAL would add this point itself, except if
/// the first and the last corner have equal coordinates.
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
  // The Delaunay triangulation shuffles its points, and for points on a sphere the result depends
  // on the order. By default the seed is the time, and every thread continues from its previous
  // hole.
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
