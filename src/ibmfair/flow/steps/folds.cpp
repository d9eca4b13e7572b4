#include "ibmfair/flow/steps/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Flags (#H) of the hinges with a near vertex and a smaller dihedral angle than `angle`. `near`:
/// #V flags, or empty if all vertices are near.
std::vector<std::uint8_t> folded_near(const Points& X, const Topology& topology, double angle,
                                      const std::vector<std::uint8_t>& near) {
  const auto is_near = [&](Index v) { return near.empty() || near[v] != 0; };
  std::vector<Vec3> normals(static_cast<std::size_t>(topology.F.rows()));
  parallel_for(topology.F.rows(), [&](std::int64_t t) {
    const auto x = topology.F.row(t);
    if (is_near(x[0]) || is_near(x[1]) || is_near(x[2])) {
      normals[t] = double_area_vector(X, topology.F, t);
    }
  });
  // The dihedral angle theta is smaller if cos(theta) = -<n0, n1> > cos(angle).
  const double cosine = std::cos(angle), cos_squared = cosine * cosine;
  const auto is_folded = [&](std::int64_t h) {
    const auto t = topology.hinge_triangles.row(h);
    const Vec3 &N0 = normals[t[0]], &N1 = normals[t[1]];
    const bool agree =
        topology.orientable || runs_along(topology.F, t[1], topology.H(h, 1), topology.H(h, 0));
    const double dot = agree ? N0.dot(N1) : -N0.dot(N1);
    if (dot > 0) {  // nearly always
      return false;
    }
    const double scale = N0.squaredNorm() * N1.squaredNorm();
    return !(scale > 0) || dot * dot > cos_squared * scale;
  };
  std::vector<std::uint8_t> folded(static_cast<std::size_t>(topology.H.rows()));
  parallel_for(topology.H.rows(), [&](std::int64_t h) {
    folded[h] = is_near(topology.H(h, 0)) && is_folded(h) ? 1 : 0;
  });
  return folded;
}

}  // namespace

std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology, double angle) {
  return folded_near(X, topology, angle, {});
}

double least_turn(double angle) {
  // For a slightly larger angle, because the energy and folded_near() round differently.
  return 1 + std::cos(1.01 * angle);
}

FoldWatch::FoldWatch(const Points& X, const Topology& topology)
    : topology_(topology), known_(folded_hinges(X, topology)) {}

std::vector<Index> FoldWatch::new_folds(const Points& X,
                                        const std::vector<std::uint8_t>& near) const {
  const std::vector<std::uint8_t> folded = folded_near(X, topology_, fold_angle, near);
  std::vector<Index> vertices;
  for (std::size_t h = 0; h < folded.size(); ++h) {
    if (folded[h] && !known_[h]) {
      const auto x = topology_.H.row(static_cast<Eigen::Index>(h));
      vertices.insert(vertices.end(), x.begin(), x.end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<Index> move_without_folds(Points moves, const Topology& topology, Points& X) {
  const FoldWatch folds(X, topology);
  const Points start = X;
  X += moves;
  std::vector<Index> shortened;
  std::vector<Index> folding = folds.new_folds(X);
  for (int i = 0; !folding.empty(); ++i, folding = folds.new_folds(X)) {
    bool changes = false;
    for (const Index v : folding) {
      changes = changes || moves.row(v).squaredNorm() > 0;
      moves.row(v) *= i < tuning.guard.most_halvings ? 0.5 : 0;
      X.row(v) = start.row(v) + moves.row(v);
      shortened.push_back(v);
    }
    if (!changes) {  // they were folded by rounding
      X = start;
      break;
    }
  }
  return shortened;
}

}  // namespace ibmfair
