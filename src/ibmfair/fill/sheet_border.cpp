#include "ibmfair/fill/sheet_border.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ibmfair/base/angle.h"

namespace ibmfair {
namespace {

constexpr double strip_width = 0.87;  // in lengths of the crease's edges: even triangles
constexpr double least_corner_turn =
    radians(10.0);  // of two creases that determine a plane at a corner

using Kind = SheetSide::Kind;

Vec3 perpendicular(const Vec3& v, const Vec3& direction) {
  return (v - v.dot(direction) * direction).normalized();
}

/// The normals along a curve: carried along from a known end without turning about the curve, and
/// turned evenly so that they fit the other end, too.
Points normals_along(const CurvePoints& points, const std::optional<Vec3>& first,
                     const std::optional<Vec3>& last, const Vec3& otherwise) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Points N(n, 3);
  if (!first && last) {
    CurvePoints back(points.rbegin(), points.rend());
    const Points reversed = normals_along(back, last, first, otherwise);
    return reversed.colwise().reverse();
  }
  N.row(0) = perpendicular(first.value_or(otherwise), points.front().direction);
  for (Eigen::Index k = 1; k < n; ++k) {
    const auto carry =
        Eigen::Quaterniond::FromTwoVectors(points[k - 1].direction, points[k].direction);
    N.row(k) = perpendicular(carry * N.row(k - 1).transpose(), points[k].direction);
  }
  if (last) {
    const Vec3 t = points.back().direction, carried = N.row(n - 1);
    const Vec3 wanted = perpendicular(*last, t);
    const double angle = std::atan2(carried.cross(wanted).dot(t), carried.dot(wanted));
    for (Eigen::Index k = 1; k < n; ++k) {
      const double part = angle * static_cast<double>(k) / static_cast<double>(n - 1);
      N.row(k) = Eigen::AngleAxisd(part, points[k].direction) * N.row(k).transpose();
    }
  }
  return N;
}

BorderCurve oriented(const CreaseNetwork& network, const CreasedRim& rim, const SheetSide& side) {
  BorderCurve result;
  result.curve = side.number;
  result.reversed = side.kind == Kind::reversed_curve;
  const CreaseCurve& curve = network.curves[side.number];
  result.points = curve.points;
  Index from = curve.from, to = curve.to;
  if (result.reversed) {
    std::swap(from, to);
    std::ranges::reverse(result.points);
    for (CurvePoint& point : result.points) {
      point.direction = -point.direction;
    }
  }
  const auto ends = static_cast<Index>(rim.ends.size());
  result.end_before = from < ends ? from : -1;
  result.end_after = to < ends ? to : -1;
  return result;
}

}  // namespace

Vec3 mean_normal(const CreasedRim& rim, const std::vector<SheetSide>& sheet) {
  Vec3 sum = Vec3::Zero();
  for (const SheetSide& side : sheet) {
    if (side.kind == Kind::arc) {
      sum += rim.arcs[side.number].normal;
    }
    if (side.kind == Kind::arc && !rim.ends.empty()) {
      const auto next = static_cast<std::size_t>(side.number) + 1;
      sum += rim.ends[side.number].normal[1];
      sum += rim.ends[next < rim.ends.size() ? next : 0].normal[0];
    }
  }
  return sum.normalized();
}

std::vector<BorderCurve> border_curves(const CreasedRim& rim, const CreaseNetwork& network,
                                       const std::vector<SheetSide>& sheet) {
  std::vector<BorderCurve> curves;
  for (const SheetSide& side : sheet) {
    if (side.kind != Kind::arc) {
      curves.push_back(oriented(network, rim, side));
    }
  }
  const Vec3 mean = mean_normal(rim, sheet);
  std::vector<std::optional<Vec3>> first(curves.size()), last(curves.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    BorderCurve& curve = curves[i];
    if (curve.end_before >= 0) {
      first[i] = rim.ends[curve.end_before].normal[0];
    }
    if (curve.end_after >= 0) {
      last[i] = rim.ends[curve.end_after].normal[1];
      continue;
    }
    const std::size_t next = i + 1 < curves.size() ? i + 1 : 0;  // a sheet begins with an arc
    const Vec3 come = curve.points.back().direction, go = curves[next].points.front().direction;
    const Vec3 across = come.cross(go);
    const double sign = across.dot(mean) < 0 ? -1 : 1;
    curve.turn = sign * std::atan2(across.norm(), come.dot(go));
    if (std::abs(curve.turn) > least_corner_turn) {
      last[i] = first[next] = sign * across.normalized();
    }
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    CurvePoints& points = curves[i].points;
    const Points N = normals_along(points, first[i], last[i], mean);
    double length = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      length += (points[k].position - points[k - 1].position).norm();
    }
    const double width = strip_width * length / static_cast<double>(points.size() - 1);
    curves[i].beyond.resize(N.rows(), 3);
    for (Eigen::Index k = 0; k < N.rows(); ++k) {
      const Vec3 outward = points[k].direction.cross(N.row(k).transpose());
      curves[i].beyond.row(k) = points[k].position + width * outward;
    }
  }
  return curves;
}

}  // namespace ibmfair
