#include "ibmfair/flow/steps/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

/// Whether the dihedral angle theta of a hinge is smaller than an angle: cos(theta) = -<n0, n1> >
/// cos(angle), without a square root.
bool is_folded(const Points& X, const Hinges& H, std::int64_t h, double cos_squared) {
  const Vec3 x0 = X.row(H(h, 0)), x1 = X.row(H(h, 1)), x2 = X.row(H(h, 2)), x3 = X.row(H(h, 3));
  const Vec3 edge = x1 - x0;
  const Vec3 N0 = edge.cross(x2 - x0), N1 = (x3 - x0).cross(edge);  // double area vectors
  const double dot = N0.dot(N1);
  if (dot > 0) {  // nearly always
    return false;
  }
  const double scale = N0.squaredNorm() * N1.squaredNorm();
  return !(scale > 0) || dot * dot > cos_squared * scale;
}

}  // namespace

std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology, double angle) {
  std::vector<std::uint8_t> folded(static_cast<std::size_t>(topology.H.rows()));
  const double cos_squared = std::pow(std::cos(angle), 2);
  parallel_for(topology.H.rows(), [&](std::int64_t h) {
    folded[h] = is_folded(X, topology.H, h, cos_squared) ? 1 : 0;
  });
  return folded;
}

double least_turn(double angle) {
  // For a slightly larger angle, because the energy and is_folded() round differently.
  return 1 + std::cos(1.01 * angle);
}

FoldWatch::FoldWatch(const Points& X, const Topology& topology)
    : topology_(topology), known_(folded_hinges(X, topology)) {}

std::vector<Index> FoldWatch::new_folds(const Points& X,
                                        const std::vector<std::uint8_t>& near) const {
  static const double cos_squared = std::pow(std::cos(fold_angle), 2);
  const Hinges& H = topology_.H;
  std::vector<std::uint8_t> folded(known_.size());
  parallel_for(H.rows(), [&](std::int64_t h) {
    const bool may_be_new = !known_[h] && (near.empty() || near[H(h, 0)] != 0);
    folded[h] = may_be_new && is_folded(X, H, h, cos_squared) ? 1 : 0;
  });
  std::vector<Index> vertices;
  for (std::size_t h = 0; h < folded.size(); ++h) {
    if (folded[h]) {
      const auto x = H.row(static_cast<Eigen::Index>(h));
      vertices.insert(vertices.end(), x.begin(), x.end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace ibmfair
