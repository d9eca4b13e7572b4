#include "ibmfair/io/normals.h"

namespace ibmfair {

Vec3 polygon_area_vector(const Points& X, std::span<const Index> corners) {
  Vec3 sum = Vec3::Zero();
  // Computed relative to the first corner, to avoid cancellation far from the origin.
  const Vec3 origin = X.row(corners[0]);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 a = X.row(corners[i - 1]).transpose() - origin;
    const Vec3 b = X.row(corners[i]).transpose() - origin;
    sum += a.cross(b);
  }
  return sum;
}

Points vertex_normals(const Polygons& faces, const Points& X) {
  Points normals = Points::Zero(X.rows(), 3);
  for (Index f = 0; f < faces.size(); ++f) {
    const Vec3 area = polygon_area_vector(X, faces[f]);
    for (const Index v : faces[f])
      normals.row(v) += area;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0.0) normals.row(v) /= length;
  }
  return normals;
}

std::vector<std::uint8_t> faces_touching(const Polygons& faces,
                                         const std::vector<std::uint8_t>& vertices) {
  std::vector<std::uint8_t> touching(static_cast<std::size_t>(faces.size()), 0);
  for (Index f = 0; f < faces.size(); ++f) {
    for (const Index v : faces[f]) {
      if (vertices[v] != 0) touching[f] = 1;
    }
  }
  return touching;
}

RenewedNormals::RenewedNormals(const Polygons& faces, const Points& before, const Points& after,
                               const std::vector<std::uint8_t>& moved)
    : stale_(moved.size(), 0),
      before_(vertex_normals(faces, before)),
      after_(vertex_normals(faces, after)) {
  const std::vector<std::uint8_t> changed = faces_touching(faces, moved);
  for (Index f = 0; f < faces.size(); ++f) {
    if (changed[f] == 0) continue;
    for (const Index v : faces[f])
      stale_[v] = 1;
  }
}

Vec3 RenewedNormals::renew(std::int64_t vertex, const Vec3& old) const {
  const Vec3 after = after_.row(vertex);
  if (after.isZero(0.0)) return old;
  return old.dot(before_.row(vertex)) < 0.0 ? Vec3(-after) : after;
}

}  // namespace ibmfair
