#include "ibmfair/fill/surroundings.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr int rings = 3;  // of vertices around the rim
// The largest roughness of smooth surroundings. Spheres, tori and catenoids of more than 2000
// vertices are smoother; the meshes of scans are ten times as rough.
constexpr double smooth = 0.005;
// The largest likeness of noisy surroundings. White noise on a sphere has 0.3; scans have 0.6.
constexpr double independent = 0.4;

double cotangent(const Vec3& u, const Vec3& v) {
  return u.dot(v) / u.cross(v).norm();
}

/// The corner after `v`. Of an interior vertex, the triangles around it give each neighbour once.
Index next_corner(const Topology& topology, Index t, Index v) {
  const auto corner = topology.F.row(t);
  return corner[corner[0] == v ? 1 : (corner[1] == v ? 2 : 0)];
}

/// The cotangent Laplacian of the positions along the normal, per area of the vertex, 1/length.
double mean_curvature(Index v, const Points& X, const Topology& topology) {
  Vec3 laplacian = Vec3::Zero(), normal = Vec3::Zero();
  double area = 0;
  const Vec3 x = X.row(v);
  for (const Index t : topology.stars[v]) {
    const auto corner = topology.F.row(t);
    const int k = corner[0] == v ? 0 : (corner[1] == v ? 1 : 2);
    const Vec3 y = X.row(corner[(k + 1) % 3]), z = X.row(corner[(k + 2) % 3]);
    laplacian += (cotangent(x - z, y - z) * (x - y) + cotangent(x - y, z - y) * (x - z)) / 2;
    const Vec3 n = double_area_vector(x, y, z);
    normal += n;
    area += n.norm() / 6;
  }
  return laplacian.dot(normal.normalized()) / area;
}

/// Mean curvatures, each computed when it is first asked for.
class MeanCurvatures {
 public:
  MeanCurvatures(const Points& X, const Topology& topology) : X_(X), topology_(topology) {}

  double at(Index v) {
    const auto [place, is_new] = known_.try_emplace(v, 0);
    if (is_new) {
      place->second = mean_curvature(v, X_, topology_);
    }
    return place->second;
  }

 private:
  const Points& X_;
  const Topology& topology_;
  std::unordered_map<Index, double> known_;
};

std::optional<double> roughness_at(const Points& X, const Topology& topology, const Patch& patch) {
  std::vector<Index> band;
  double length = 0;
  for (const RimEdge& edge : patch.rim) {
    band.push_back(patch.mesh_vertex[edge.a]);
    length += (patch.X.row(edge.a) - patch.X.row(edge.b)).norm();
  }
  length /= static_cast<double>(patch.rim.size());
  for (int ring = 0; ring < rings; ++ring) {
    band = grown_by_ring(topology, band);
  }
  const auto is_interior = [&](Index v) {
    return topology.kind[v] == VertexKind::interior && !topology.defective[v];
  };
  MeanCurvatures curvatures(X, topology);
  std::vector<double> differences;
  for (const Index v : band) {
    if (!is_interior(v)) {
      continue;
    }
    double sum = 0;
    int count = 0;
    for (const Index t : topology.stars[v]) {
      const Index w = next_corner(topology, t, v);
      if (is_interior(w)) {
        sum += curvatures.at(w);
        ++count;
      }
    }
    const double difference = std::abs(curvatures.at(v) - sum / count) * length;
    if (std::isfinite(difference)) {
      differences.push_back(difference);
    }
  }
  if (differences.empty()) {
    return std::nullopt;
  }
  const auto middle = differences.begin() + std::ssize(differences) / 2;
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

}  // namespace

std::string_view name_of(SurroundingsKind kind) {
  switch (kind) {
    case SurroundingsKind::smooth:
      return "smooth";
    case SurroundingsKind::noisy:
      return "noisy";
    case SurroundingsKind::shaped:
      return "shaped";
  }
  return "unknown";
}

std::optional<RimSurroundings> look_around(const Points& X, const Topology& topology,
                                           const Patch& patch) {
  const std::optional<double> roughness = roughness_at(X, topology, patch);
  if (!roughness) {
    return std::nullopt;
  }
  RimSurroundings result{SurroundingsKind::smooth, *roughness};
  if (result.roughness > smooth) {
    result.shifts = direction_shifts(X, topology, patch);
    result.likeness = likeness_of_neighbors(result.shifts, topology, patch);
    result.kind =
        *result.likeness < independent ? SurroundingsKind::noisy : SurroundingsKind::shaped;
  }
  return result;
}

}  // namespace ibmfair
