#include "ibmfair/flow/distortion.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr double largest_roughness = 0.15;
constexpr double largest_strain = 0.4;

/// Sums over the unknowns; each edge counts once.
using Sums = Eigen::Array3d;  // roughness, strain, edges

}  // namespace

double distortion(const Points& step, const Rows& rings, const Unknowns& unknowns,
                  const PerVertex& edge_length, const MeshParts& parts, Points& own) {
  static const Vec3 held = Vec3::Zero();
  own.resize(unknowns.size(), 3);
  Sums sums = parallel_sum(unknowns.size(), Sums(Sums::Zero()), [&](std::int64_t u) -> Sums {
    const Index v = unknowns.vertex[u];
    const auto ring = rings[v];
    const Vec3 move = step.row(u);
    const double squared_length = edge_length[v] * edge_length[v];
    Vec3 shared = Vec3::Zero();
    double strain = 0, edges = 0;
    for (const Index w : ring) {
      const Index other = unknowns.unknown[w];
      const Vec3 others = Eigen::Map<const Vec3>(other >= 0 ? step.row(other).data() : held.data());
      const double share = other >= 0 ? 0.5 : 1;
      const double mean_square = (squared_length + edge_length[w] * edge_length[w]) / 2;
      shared += others;
      strain += share * (move - others).squaredNorm() / mean_square;
      edges += share;
    }
    const Vec3 not_shared = move - shared / std::max(1.0, static_cast<double>(ring.size()));
    own.row(u) = not_shared;
    return {not_shared.squaredNorm() / squared_length, strain, edges};
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
