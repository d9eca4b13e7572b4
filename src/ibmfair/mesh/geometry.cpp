#include "ibmfair/mesh/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// The corners of triangle t.
struct Corners {
  Vec3 a, b, c;
};

Corners corners(const Points& X, const Triangles& F, Eigen::Index t) {
  return {X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2))};
}

double area(const Corners& corners) {
  return double_area_vector(corners.a, corners.b, corners.c).norm() / 2;
}

/// Sine and cosine of an angle, both multiplied by the lengths of the two edges at the angle.
struct Angle {
  double sine, cosine;
};

double radians(const Angle& angle) {
  return angle.sine > 0 ? std::atan2(angle.sine, angle.cosine) : 0;
}

Angle smallest_angle(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 u = b - a, v = c - b, w = a - c;
  // The product of the sine and the two lengths is the same for all three angles, twice the area;
  // so the smallest angle is the one with the largest product of cosine and lengths.
  return {u.cross(v).norm(), std::max({-u.dot(w), -v.dot(u), -w.dot(v)})};
}

/// Twice the longest height-to-edge ratio that rounding alone can produce.
constexpr double flatness_limit = 1e-12;

bool is_degenerate(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  const double height = longest > 0 ? double_area_vector(a, b, c).norm() / longest : 0;
  // Coordinates carry an absolute error that grows with the distance from the origin.
  const double magnitude = a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(c.cwiseAbs()).maxCoeff();
  const double noise = 4 * std::numeric_limits<double>::epsilon() * magnitude;
  return !(height > flatness_limit * longest && height > noise);
}

}  // namespace

Eigen::VectorXd triangle_areas(const Points& X, const Triangles& F) {
  Eigen::VectorXd areas(F.rows());
  parallel_for(F.rows(), [&](std::int64_t t) { areas[t] = area(corners(X, F, t)); });
  return areas;
}

Points triangle_normals(const Points& X, const Triangles& F) {
  Points normals(F.rows(), 3);
  parallel_for(F.rows(), [&](std::int64_t t) {
    const auto [a, b, c] = corners(X, F, t);
    const Vec3 n = double_area_vector(a, b, c);
    const double length = n.norm();
    normals.row(t) = length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
  });
  return normals;
}

std::vector<Index> degenerate_triangles(const Points& X, const Triangles& F) {
  return indices_where(F.rows(), [&](Index t) { return is_degenerate(corners(X, F, t)); });
}

double surface_area(const Points& X, const Triangles& F) {
  return parallel_sum(F.rows(), [&](std::int64_t t) { return area(corners(X, F, t)); });
}

double enclosed_volume(const Points& X, const Triangles& F) {
  if (X.rows() == 0) {
    return 0;
  }
  // If the mesh is far from the origin, the plain formula with cones from the origin suffers from
  // cancellation; with cones from the centroid it does not.
  const Vec3 centre = X.colwise().mean();
  const double six_volumes = parallel_sum(F.rows(), [&](std::int64_t t) {
    const auto [a, b, c] = corners(X, F, t);
    return (a - centre).dot((b - centre).cross(c - centre));
  });
  return six_volumes / 6;
}

double mean_edge_length(const Points& X, const Edges& E) {
  const double sum = parallel_sum(
      E.rows(), [&](std::int64_t e) { return (X.row(E(e, 0)) - X.row(E(e, 1))).norm(); });
  return E.rows() > 0 ? sum / static_cast<double>(E.rows()) : 0;
}

Vec3 double_area_vector_at(Index v, const Points& X, const Topology& topology) {
  Vec3 sum = Vec3::Zero();
  for (const Index t : topology.stars[v]) {
    sum += double_area_vector(X, topology.F, t);
  }
  return sum;
}

PerVertex lumped_vertex_mass(const Points& X, const Topology& topology) {
  const Eigen::VectorXd areas = triangle_areas(X, topology.F);
  PerVertex mass(topology.vertex_count);
  parallel_for(topology.vertex_count, [&](std::int64_t v) {
    double sum = 0;
    for (const Index t : topology.stars[static_cast<Index>(v)]) {
      sum += topology.usable[t] ? areas[t] / 3 : 0;
    }
    mass[v] = sum;
  });
  return mass;
}

PerVertex local_edge_length(const Points& X, const CompressedRows& rings) {
  PerVertex length(rings.size());
  parallel_for(rings.size(), [&](std::int64_t v) {
    const auto ring = rings[static_cast<Index>(v)];
    double sum = 0;
    for (const Index w : ring) {
      sum += (X.row(w) - X.row(v)).norm();
    }
    length[v] = sum / static_cast<double>(std::max<std::size_t>(1, ring.size()));
  });
  return length;
}

Vec3 bounding_box_size(const Points& X) {
  if (X.rows() == 0) {
    return Vec3::Zero();
  }
  return X.colwise().maxCoeff() - X.colwise().minCoeff();
}

Eigen::VectorXd smallest_angles(const Points& X, const Triangles& F) {
  Eigen::VectorXd angles(F.rows());
  parallel_for(F.rows(),
               [&](std::int64_t t) { angles[t] = radians(smallest_angle(corners(X, F, t))); });
  return angles;
}

double smallest_angle(const Points& X, const Triangles& F) {
  if (F.rows() == 0) {
    return 0;
  }
  Eigen::VectorXd cotangents(F.rows());
  parallel_for(F.rows(), [&](std::int64_t t) {
    const auto [sine, cosine] = smallest_angle(corners(X, F, t));
    cotangents[t] = sine > 0 ? cosine / sine : std::numeric_limits<double>::infinity();
  });
  Eigen::Index sharpest = 0;
  cotangents.maxCoeff(&sharpest);
  return radians(smallest_angle(corners(X, F, sharpest)));
}

std::vector<Index> needles(const Points& X, const Triangles& F, double angle) {
  const double tangent = std::tan(angle);
  return indices_where(F.rows(), [&](Index t) {
    const auto [sine, cosine] = smallest_angle(corners(X, F, t));
    return sine <= tangent * cosine;
  });
}

Eigen::VectorXd dihedral_angles(const Points& X, const Hinges& H) {
  Eigen::VectorXd angles(H.rows());
  parallel_for(H.rows(), [&](std::int64_t i) {
    const Vec3 x0 = X.row(H(i, 0)), x1 = X.row(H(i, 1)), x2 = X.row(H(i, 2)), x3 = X.row(H(i, 3));
    const Vec3 n0 = double_area_vector(x0, x1, x2), n1 = double_area_vector(x1, x0, x3);
    angles[i] = std::numbers::pi - std::atan2(n0.cross(n1).norm(), n0.dot(n1));
  });
  return angles;
}

}  // namespace ibmfair
