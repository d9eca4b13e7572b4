#include "ibmfair/fill/hole_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Has_timestamp.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Random.h>
#include <Eigen/Geometry>

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
      CGAL::parameters::use_delaunay_triangulation(true).do_not_use_cubic_algorithm(
          loop.rows() > longest_searched_loop));
  Triangles F(static_cast<Eigen::Index>(found.size()), 3);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      F(t, i) = found[static_cast<std::size_t>(t)].index[i];
    }
  }
  return F;
}

namespace {

constexpr Eigen::Index most_pairs = 25'000'000;  // of corners of two polygons

/// The cost of a triangle of a strip: at an edge from a to b of one polygon, with the third corner
/// on the other polygon.
using StripCost = double (*)(const Vec3& a, const Vec3& b, const Vec3& opposite);

double area_cost(const Vec3& a, const Vec3& b, const Vec3& opposite) {
  return (b - a).cross(opposite - a).norm();
}

/// In all, the squared distance between the polygons, integrated along both.
double distance_cost(const Vec3& a, const Vec3& b, const Vec3& opposite) {
  return (b - a).norm() * ((a + b) / 2 - opposite).squaredNorm();
}

/// Dynamic programme over strips of triangles between two polygons that run side by side, from the
/// pair of corners (0, 0) back to itself. After i edges of p and j edges of r, the strip ends at
/// the edge from p_i to r_j. The cheapest strip may go round one polygon at a single corner of the
/// other and so use an edge twice. A strip cannot if it has to begin with an edge of p and to end
/// with an edge of r (`without_fans`).
class Strip {
 public:
  Strip(Points p, Points r, StripCost cost, bool without_fans)
      : p_(std::move(p)), r_(std::move(r)), n_(p_.rows()), m_(r_.rows()) {
    by_p_.resize((n_ + 1) * (m_ + 1), 0);
    std::vector<double> before(m_ + 1), now(m_ + 1);
    for (Eigen::Index i = 0; i <= n_; ++i) {
      for (Eigen::Index j = 0; j <= m_; ++j) {
        const double along_p = i > 0 ? before[j] + cost(P(i - 1), P(i), R(j)) : endless;
        const double along_r = j > 0 ? now[j - 1] + cost(R(j), R(j - 1), P(i)) : endless;
        bool by_p = j == 0 || (i > 0 && along_p <= along_r);
        now[j] = i + j == 0 ? 0 : std::min(along_p, along_r);
        if (without_fans && ((i == 0 && j > 0) || (i == n_ && j == 0))) {
          now[j] = endless;
        } else if (without_fans && i == n_ && j == m_) {
          by_p = false;
        }
        by_p_[i * (m_ + 1) + j] = by_p ? 1 : 0;
      }
      before.swap(now);
    }
  }

  /// Triangles whose corners are i for p_i and n + j for r_j.
  Triangles triangles() const {
    Triangles F(n_ + m_, 3);
    Eigen::Index i = n_, j = m_;
    for (auto x : F.rowwise()) {
      const auto p = static_cast<Index>(i % n_), r = static_cast<Index>(n_ + j % m_);
      if (by_p_[i * (m_ + 1) + j]) {
        x << static_cast<Index>(--i), p, r;
      } else {
        x << p, r, static_cast<Index>(n_ + --j);
      }
    }
    return F;
  }

  /// Whether the strip goes round one of the polygons at a single corner of the other.
  bool has_fan() const {
    Eigen::Index i = n_, j = m_, run = 0, longest_p = 0, longest_r = 0;
    bool last = false;
    while (i + j > 0) {
      const bool by_p = by_p_[i * (m_ + 1) + j] != 0;
      run = by_p == last ? run + 1 : 1;
      last = by_p;
      (by_p ? longest_p : longest_r) = std::max(by_p ? longest_p : longest_r, run);
      (by_p ? i : j) -= 1;
    }
    return longest_p == n_ || longest_r == m_;
  }

 private:
  static constexpr double endless = std::numeric_limits<double>::infinity();

  Vec3 P(Eigen::Index i) const { return p_.row(i % n_); }
  Vec3 R(Eigen::Index j) const { return r_.row(j % m_); }

  Points p_, r_;
  Eigen::Index n_, m_;
  std::vector<std::uint8_t> by_p_;  // whether the last triangle lies at an edge of p
};

Triangles cheapest_strip(const Points& outer, const Points& inner, StripCost cost) {
  const Eigen::Index n = outer.rows(), m = inner.rows();
  if (n * m > most_pairs) {
    return {};
  }
  Eigen::Index i0 = 0, j0 = 0;  // the closest pair
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Index j = 0;
    const double distance = (inner.rowwise() - outer.row(i)).rowwise().squaredNorm().minCoeff(&j);
    if (distance < least) {
      least = distance;
      i0 = i;
      j0 = j;
    }
  }
  // The inner polygon is walked backwards, side by side with the outer one.
  const auto row_of_p = [&](Eigen::Index i) { return (i0 + i) % n; };
  const auto row_of_r = [&](Eigen::Index j) { return (j0 + m - j) % m; };
  Points p(n, 3), r(m, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    p.row(i) = outer.row(row_of_p(i));
  }
  for (Eigen::Index j = 0; j < m; ++j) {
    r.row(j) = inner.row(row_of_r(j));
  }
  const Strip cheapest(p, r, cost, false);
  Triangles F = cheapest.has_fan() ? Strip(p, r, cost, true).triangles() : cheapest.triangles();
  for (Index& corner : F.reshaped()) {
    corner = static_cast<Index>(corner < n ? row_of_p(corner) : n + row_of_r(corner - n));
  }
  return F;
}

/// The middle of a polygon, and its area vector.
struct PolygonFrame {
  Vec3 middle, area = Vec3::Zero();
  double size = 0;  // root mean square distance of the corners from the middle, length

  explicit PolygonFrame(const Points& X) : middle(X.colwise().mean()) {
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const Vec3 a = X.row(i).transpose() - middle;
      const Vec3 b = X.row((i + 1) % X.rows()).transpose() - middle;
      area += a.cross(b) / 2;
      size += a.squaredNorm() / static_cast<double>(X.rows());
    }
    size = std::max(std::sqrt(size), std::numeric_limits<double>::min());
  }
};

/// The linear map of the plane of one polygon to that of another that a tube between them makes. If
/// the polygons face each other, as the ends of an S do, it is a rotation; if they face alike, as
/// the ends of a U do, the reflection that maps one end of the U to the other, with a rotation that
/// makes up for differences.
Eigen::Matrix3d along_tube(const PolygonFrame& from, const PolygonFrame& to) {
  const Vec3 n = to.area.stableNormalized(), m = from.area.stableNormalized();
  if (n.dot(m) <= 0) {
    return Eigen::Quaterniond::FromTwoVectors(-m, n).toRotationMatrix();
  }
  Vec3 across = (from.middle - to.middle).stableNormalized();
  if (!(across.norm() > 0)) {
    across = n.unitOrthogonal();
  }
  const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2 * across * across.transpose();
  return Eigen::Quaterniond::FromTwoVectors(mirror * m, n).toRotationMatrix() * mirror;
}

}  // namespace

Triangles triangulate_ring(const Points& outer, const Points& inner) {
  return cheapest_strip(outer, inner, area_cost);
}

Triangles triangulate_tube(const Points& one, const Points& other) {
  const PolygonFrame frame(one), other_frame(other);
  const Eigen::Matrix3d map = along_tube(other_frame, frame);
  const Points X = (one.rowwise() - frame.middle.transpose()) / frame.size;
  const Points Y =
      (other.rowwise() - other_frame.middle.transpose()) * map.transpose() / other_frame.size;
  return cheapest_strip(X, Y, distance_cost);
}

}  // namespace ibmfair
