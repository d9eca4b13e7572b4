#include "ibmfair/flow/distortion.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr double largest_roughness = 0.15;
constexpr double largest_strain = 0.4;

}  // namespace

double distortion(const Points& step, const Topology& topology, const Unknowns& unknowns,
                  const PerVertex& edge_length) {
  Points shared = Points::Zero(unknowns.size(), 3);  // sum of the neighbours' moves
  Eigen::VectorXd valence = Eigen::VectorXd::Zero(unknowns.size());
  double strain = 0;
  std::int64_t edges = 0;
  for (const auto edge : topology.E.rowwise()) {
    const Index a = unknowns.unknown[edge[0]], b = unknowns.unknown[edge[1]];
    if (a < 0 && b < 0) {
      continue;
    }
    const Vec3 move_a = a >= 0 ? Vec3(step.row(a)) : Vec3(Vec3::Zero());
    const Vec3 move_b = b >= 0 ? Vec3(step.row(b)) : Vec3(Vec3::Zero());
    const double length_a = edge_length[edge[0]], length_b = edge_length[edge[1]];
    strain += 2 * (move_a - move_b).squaredNorm() / (length_a * length_a + length_b * length_b);
    ++edges;
    if (a >= 0) {
      shared.row(a) += move_b;
      valence[a] += 1;
    }
    if (b >= 0) {
      shared.row(b) += move_a;
      valence[b] += 1;
    }
  }
  if (edges == 0) {
    return 0;
  }
  const double roughness = parallel_sum(unknowns.size(), [&](std::int64_t u) {
    const Vec3 own = step.row(u) - shared.row(u) / std::max(valence[u], 1.0);
    return own.squaredNorm() / std::pow(edge_length[unknowns.vertex[u]], 2);
  });
  return std::max(std::sqrt(roughness / unknowns.size()) / largest_roughness,
                  std::sqrt(strain / static_cast<double>(edges)) / largest_strain);
}

}  // namespace ibmfair
