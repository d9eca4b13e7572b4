// Cuts polygons into triangles. Every polygon gives as many triangles as it has corners, minus two;
// if geometry does not determine how to cut (no area, crossing edges), any cut is accepted.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {
namespace {

using Vec2 = Eigen::Vector2d;

/// Polygons with more corners than this are cut as a fan, because the search for ears takes time
/// quadratic in the number of corners.
constexpr std::size_t most_ear_corners = 4096;

/// How often a polygon that has run out of ears may be searched again from scratch.
constexpr int most_fresh_searches = 16;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area of a triangle in the plane.
double double_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

/// The smallest angle in radians, with the sign of the area. The result is never NaN, because
/// std::min skips angles that are NaN.
double signed_smallest_angle(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double area = double_area(a, b, c);
  const std::array<double, 3> dots{(b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c)};
  double smallest = M_PI;
  for (const double dot : dots)
    smallest = std::min(smallest, std::atan2(std::abs(area), dot));
  return area < 0.0 ? -smallest : smallest;
}

/// Projects the corners to their best-fit plane, in which the polygon has positive area. The normal
/// of the plane is the area vector ([Newell]); if that is zero, any plane is as good.
std::vector<Vec2> project(const Points& X, std::span<const Index> polygon) {
  const Vec3 origin = X.row(polygon[0]);
  Vec3 normal = Vec3::Zero();
  double scale = 0.0;
  std::vector<Vec3> points;
  points.reserve(polygon.size());
  for (const Index v : polygon) {
    points.emplace_back(X.row(v).transpose() - origin);
    scale = std::max(scale, points.back().cwiseAbs().maxCoeff());
  }
  // Scale to size one, so that products neither overflow nor underflow.
  if (scale > 0.0) {
    for (Vec3& p : points)
      p /= scale;
  }
  for (std::size_t i = 2; i < points.size(); ++i)
    normal += points[i - 1].cross(points[i]);
  const Vec3 n = normal.norm() > 0.0 ? normal.normalized() : Vec3::UnitZ();
  const Vec3 u = n.unitOrthogonal();
  const Vec3 w = n.cross(u);
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points)
    flat.emplace_back(u.dot(p), w.dot(p));
  return flat;
}

/// Cuts one polygon of five or more corners.
class EarCutter {
 public:
  explicit EarCutter(std::vector<Vec2> points) : points_(std::move(points)) {
    const std::size_t n = points_.size();
    next_.resize(n);
    previous_.resize(n);
    quality_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    search_all();
  }

  /// Calls add(a, b, c) with the corner numbers of each triangle.
  template <class Add>
  void run(Add&& add) {
    std::size_t left = points_.size();
    for (; left > 3; --left) {
      const std::size_t ear = best_ear();
      const std::size_t before = previous_[ear];
      const std::size_t after = next_[ear];
      add(before, ear, after);
      next_[before] = after;
      previous_[after] = before;
      start_ = after;
      quality_[before] = rate(before);
      quality_[after] = rate(after);
    }
    add(previous_[start_], start_, next_[start_]);
  }

 private:
  void search_all() {
    std::size_t i = start_;
    do {
      quality_[i] = rate(i);
      i = next_[i];
    } while (i != start_);
  }

  /// Rates cutting off corner i. For an ear, the rating is positive: the smallest angle of its
  /// triangle. Then come corners without area, then ears blocked by another part of the polygon,
  /// then reflex corners.
  double rate(std::size_t i) const {
    const Vec2& a = points_[previous_[i]];
    const Vec2& b = points_[i];
    const Vec2& c = points_[next_[i]];
    const double angle = signed_smallest_angle(a, b, c);
    if (angle > 0.0) return is_blocked(i) ? angle - M_PI : angle;
    return angle < 0.0 ? angle - 2.0 * M_PI : 0.0;
  }

  bool is_blocked(std::size_t i) const {
    const std::size_t first = previous_[i];
    const std::size_t last = next_[i];
    const Vec2& a = points_[first];
    const Vec2& b = points_[i];
    const Vec2& c = points_[last];
    for (std::size_t k = next_[last]; k != first; k = next_[k]) {
      const Vec2& p = points_[k];
      // A corner at the same position only touches the ear; bridges to holes produce such corners.
      if (p == a || p == b || p == c) continue;
      if (double_area(a, b, p) >= 0.0 && double_area(b, c, p) >= 0.0 &&
          double_area(c, a, p) >= 0.0) {
        return true;
      }
    }
    return false;
  }

  std::size_t best_ear() {
    std::size_t best = best_rated();
    // If edges cross, cutting one ear can unblock another that is not its neighbour.
    if (!(quality_[best] > 0.0) && fresh_searches_ < most_fresh_searches) {
      ++fresh_searches_;
      search_all();
      best = best_rated();
    }
    return best;
  }

  std::size_t best_rated() const {
    std::size_t best = start_;
    for (std::size_t i = next_[start_]; i != start_; i = next_[i]) {
      const bool better =
          quality_[i] > quality_[best] || (quality_[i] == quality_[best] && i < best);
      if (better) best = i;
    }
    return best;
  }

  std::vector<Vec2> points_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
  std::vector<double> quality_;
  std::size_t start_ = 0;  // a corner that is not cut off yet
  int fresh_searches_ = 0;
};

/// Whether the diagonal from corner 1 to corner 3 gives the larger smallest angle.
bool prefers_second_diagonal(const std::vector<Vec2>& p) {
  const double first =
      std::min(signed_smallest_angle(p[0], p[1], p[2]), signed_smallest_angle(p[0], p[2], p[3]));
  const double second =
      std::min(signed_smallest_angle(p[0], p[1], p[3]), signed_smallest_angle(p[1], p[2], p[3]));
  return second > first;
}

/// Calls add(a, b, c) with the corner numbers of each triangle of a polygon.
template <class Add>
void cut(const Points& X, std::span<const Index> polygon, Add&& add) {
  const std::size_t n = polygon.size();
  if (n == 4 && prefers_second_diagonal(project(X, polygon))) {
    add(0, 1, 3);
    add(1, 2, 3);
  } else if (n > 4 && n <= most_ear_corners) {
    EarCutter(project(X, polygon)).run(add);
  } else {
    for (std::size_t i = 2; i < n; ++i)
      add(std::size_t{0}, i - 1, i);
  }
}

}  // namespace

Triangulation triangulate(const Mesh& mesh) {
  const Polygons& faces = mesh.faces;
  Eigen::Index count = 0;
  bool only_triangles = true;
  for (Index f = 0; f < faces.size(); ++f) {
    const auto corners = static_cast<Eigen::Index>(faces[f].size());
    count += std::max<Eigen::Index>(0, corners - 2);
    only_triangles = only_triangles && corners == 3;
  }
  Triangulation result;
  result.F.resize(count, 3);
  result.face.resize(static_cast<std::size_t>(count));
  if (only_triangles) {
    std::copy_n(faces.corner.data(), result.F.size(), result.F.data());
    std::iota(result.face.begin(), result.face.end(), 0);
    return result;
  }
  Eigen::Index row = 0;
  for (Index f = 0; f < faces.size(); ++f) {
    const std::span<const Index> polygon = faces[f];
    cut(mesh.X, polygon, [&](std::size_t a, std::size_t b, std::size_t c) {
      result.F.row(row) << polygon[a], polygon[b], polygon[c];
      result.face[row++] = f;
    });
  }
  return result;
}

Mesh mesh_from_triangles(Points X, const Triangles& F) {
  Mesh mesh;
  mesh.X = std::move(X);
  mesh.faces.corner.assign(F.data(), F.data() + F.size());
  mesh.faces.first.resize(static_cast<std::size_t>(F.rows()) + 1);
  for (std::size_t f = 0; f < mesh.faces.first.size(); ++f) {
    mesh.faces.first[f] = static_cast<std::int64_t>(3 * f);
  }
  return mesh;
}

}  // namespace ibmfair
