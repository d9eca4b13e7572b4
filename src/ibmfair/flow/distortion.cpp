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

/// Sums over the unknowns; each edge counts once.
using Sums = Eigen::Array3d;  // roughness, strain, edges

}  // namespace

void own_moves(const Points& step, const Rows& rings, const Unknowns& unknowns, Points& own) {
  own.resize(unknowns.size(), 3);
  parallel_for(unknowns.size(), [&](std::int64_t u) {
    const auto ring = rings[unknowns.vertex[u]];
    Vec3 shared = Vec3::Zero();
    for (const Index w : ring) {
      shared += move_of(step, unknowns.unknown[w]);
    }
    own.row(u) = step.row(u) - shared.transpose() / std::max(1.0, static_cast<double>(ring.size()));
  });
}

double distortion(const Points& step, const Points& own, const Rows& rings,
                  const Unknowns& unknowns, const PerVertex& edge_length, const MeshParts& parts) {
  Sums sums = parallel_sum(unknowns.size(), Sums(Sums::Zero()), [&](std::int64_t u) -> Sums {
    const Index v = unknowns.vertex[u];
    const double squared_length = edge_length[v] * edge_length[v];
    Sums at_vertex(own.row(u).squaredNorm() / squared_length, 0, 0);
    for (const Index w : rings[v]) {
      const Index other = unknowns.unknown[w];
      const double share = other >= 0 ? 0.5 : 1;
      const double change = (step.row(u).transpose() - move_of(step, other)).squaredNorm();
      at_vertex[1] += share * 2 * change / (squared_length + edge_length[w] * edge_length[w]);
      at_vertex[2] += share;
    }
    return at_vertex;
  });
  sums = sums.unaryExpr([&parts](double x) { return parts.sum(x); });
  const double count = parts.sum(unknowns.size());
  if (sums[2] == 0) {
    return 0;
  }
  return std::max(std::sqrt(sums[0] / count) / largest_roughness,
                  std::sqrt(sums[1] / sums[2]) / largest_strain);
}

}  // namespace ibmfair
