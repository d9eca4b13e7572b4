#include "ibmfair/flow/distortion.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr double largest_roughness = 0.15;
constexpr double largest_strain = 0.4;

Vec3 move_of(const Points& step, Index unknown) {
  return unknown >= 0 ? Vec3(step.row(unknown)) : Vec3(Vec3::Zero());
}

}  // namespace

Points own_moves(const Points& step, const Topology& topology, const Unknowns& unknowns) {
  Points shared = Points::Zero(unknowns.size(), 3);
  Eigen::VectorXd valence = Eigen::VectorXd::Zero(unknowns.size());
  for (const auto edge : topology.E.rowwise()) {
    for (const int side : {0, 1}) {
      if (const Index u = unknowns.unknown[edge[side]]; u >= 0) {
        shared.row(u) += move_of(step, unknowns.unknown[edge[1 - side]]);
        valence[u] += 1;
      }
    }
  }
  return step - valence.cwiseMax(1).cwiseInverse().asDiagonal() * shared;
}

double distortion(const Points& step, const Points& own, const Topology& topology,
                  const Unknowns& unknowns, const PerVertex& edge_length) {
  double strain = 0;
  std::int64_t edges = 0;
  for (const auto edge : topology.E.rowwise()) {
    const Index a = unknowns.unknown[edge[0]], b = unknowns.unknown[edge[1]];
    if (a >= 0 || b >= 0) {
      const double length_a = edge_length[edge[0]], length_b = edge_length[edge[1]];
      strain += 2 * (move_of(step, a) - move_of(step, b)).squaredNorm() /
                (length_a * length_a + length_b * length_b);
      ++edges;
    }
  }
  if (edges == 0) {
    return 0;
  }
  const double roughness = parallel_sum(unknowns.size(), [&](std::int64_t u) {
    return own.row(u).squaredNorm() / std::pow(edge_length[unknowns.vertex[u]], 2);
  });
  return std::max(std::sqrt(roughness / unknowns.size()) / largest_roughness,
                  std::sqrt(strain / static_cast<double>(edges)) / largest_strain);
}

}  // namespace ibmfair
