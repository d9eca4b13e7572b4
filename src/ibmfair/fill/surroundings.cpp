#include "ibmfair/fill/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <vector>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr int rings = 3;  // of vertices around the rim
// The largest roughness of smooth surroundings. Spheres, tori and catenoids of more than 2000
// vertices are smoother; the meshes of scans are ten times as rough.
constexpr double smooth = 0.005;
// The largest likeness of noisy surroundings. White noise on a sphere has 0.3; scans have 0.6.
constexpr double independent = 0.4;
// Radians, and the least share of hinges that turn less: noise turns all hinges.
constexpr double sharp_turn = radians(60), flat_turn = radians(0.1), flat_share = 0.3;

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

std::optional<double> roughness_at(const Points& X, const Topology& topology, const Patch& patch,
                                   const std::vector<Index>& band) {
  const double length = mean_rim_edge_length(patch);
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
  return median(differences);
}

/// The angles by which the surface turns at the hinges in the band, radians.
std::vector<double> turns_in(const Points& X, const Topology& topology,
                             const std::vector<Index>& band) {
  std::map<std::array<Index, 2>, Vec3> waiting;  // the normals of triangles, by their edges
  std::vector<double> turns;
  for (const Index v : band) {
    for (const Index t : topology.stars[v]) {
      if (topology.F(t, 0) != v) {
        continue;  // each triangle once: from its first corner
      }
      const Vec3 N = double_area_vector(X, topology.F, t);
      for (int i = 0; i < 3; ++i) {
        const Index a = topology.F(t, i), b = topology.F(t, (i + 1) % 3);
        if (const auto other = waiting.find({b, a}); other != waiting.end()) {
          turns.push_back(std::atan2(N.cross(other->second).norm(), N.dot(other->second)));
        } else {
          waiting[{a, b}] = N;
        }
      }
    }
  }
  return turns;
}

bool has_creases(const std::vector<double>& turns) {
  return std::ranges::any_of(turns, [](double turn) { return turn > sharp_turn; });
}

bool has_planes(const std::vector<double>& turns) {
  const auto flat = std::ranges::count_if(turns, [](double turn) { return turn < flat_turn; });
  return static_cast<double>(flat) > flat_share * static_cast<double>(turns.size());
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
  const std::vector<Index> band = vertices_around_rim(topology, patch, rings);
  const std::optional<double> roughness = roughness_at(X, topology, patch, band);
  if (!roughness) {
    return std::nullopt;
  }
  RimSurroundings result{SurroundingsKind::smooth, *roughness};
  if (result.roughness > smooth) {
    const std::vector<double> turns = turns_in(X, topology, band);
    result.has_creases = has_creases(turns);
    result.has_planes = has_planes(turns);
    result.shifts = direction_shifts(X, topology, patch);
    result.likeness = likeness_of_neighbors(result.shifts, topology, patch);
    const bool noisy = *result.likeness < independent && !result.has_planes;
    result.kind = noisy ? SurroundingsKind::noisy : SurroundingsKind::shaped;
  }
  return result;
}

}  // namespace ibmfair
