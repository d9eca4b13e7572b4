#include "ibmfair/flow/steps/distortion.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/steps/ring_kernels.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// Sums over the unknowns, in which each edge counts once.
using Sums = Eigen::Array2d;  // roughness, strain

/// find_unshared() for one vertex.
Unshared unshared(const Row4& move, std::span<const Index> ring, const std::vector<Row4>& moves) {
  Vec3 shared = Vec3::Zero();
  double strain = 0;
  for (const Index w : ring) {
    const Row4& other = moves[w];
    const double twice_the_share = other.w < 0 ? 2 : 1;
    strain += twice_the_share * (move.xyz() - other.xyz()).squaredNorm() /
              (std::abs(move.w) + std::abs(other.w));
    shared += other.xyz();
  }
  const Vec3 own = move.xyz() - shared / std::max(1.0, static_cast<double>(ring.size()));
  return {{own.x(), own.y(), own.z(), own.squaredNorm() / std::abs(move.w)}, {strain, 0, 0, 0}};
}

}  // namespace

Distortion::Distortion(const RingGroups& rings, const Unknowns& unknowns, const MeshParts& parts)
    : rings_(rings), unknowns_(unknowns), parts_(parts) {
  edges_ = parallel_sum(unknowns_.size(), [&](std::int64_t u) {
    double edges = 0;
    for (const Index w : rings.rings[unknowns_.vertex[u]]) {
      edges += unknowns_.unknown[w] >= 0 ? 0.5 : 1;
    }
    return edges;
  });
}

double Distortion::of(const Points& step, const PerVertex& edge_length, Points& own) {
  moves_.resize(static_cast<std::size_t>(edge_length.size()));
  parallel_for(edge_length.size(), [&](std::int64_t v) {
    const Index u = unknowns_.unknown[v];
    const double squared_length = edge_length[v] * edge_length[v];
    moves_[v] = u >= 0 ? Row4{step(u, 0), step(u, 1), step(u, 2), squared_length}
                       : Row4{0, 0, 0, -squared_length};
  });
  own.resize(unknowns_.size(), 3);
  const auto take = [&](Index v, const Unshared& part, Sums& sums) {
    if (const Index u = unknowns_.unknown[v]; u >= 0 && u < unknowns_.size()) {
      own.row(u) = part.own.xyz();
      sums += Sums(part.own.w, part.strain.x);
    }
  };
  std::vector<Sums> partial(static_cast<std::size_t>(rings_.parts()), Sums::Zero());
  run_tasks(rings_.parts(), rings_.are_worth_sharing(), [&](std::int64_t part) {
    const RingRange range(rings_, part);
    ForPart<Unshared> results;
    find_unshared(range, moves_.data(), results);
    range.for_each([&](Index v, std::int64_t i) { take(v, results[i], partial[part]); });
  });
  Sums sums = Sums::Zero();
  for (const Sums& some : partial) {
    sums += some;
  }
  for (const Index v : rings_.others) {
    take(v, unshared(moves_[v], rings_.rings[v], moves_), sums);
  }
  sums = sums.unaryExpr([&](double x) { return parts_.sum(x); });
  const double count = parts_.sum(unknowns_.size()), edges = parts_.sum(edges_);
  if (edges == 0) {
    return 0;
  }
  return std::max(std::sqrt(sums[0] / count) / tuning.distortion.largest_roughness,
                  std::sqrt(sums[1] / edges) / tuning.distortion.largest_strain);
}

std::int64_t shorten_own_moves(const Unknowns& unknowns, const Points& own,
                               const PerVertex& edge_length, Points& step) {
  const double shortened = parallel_sum(unknowns.size(), [&](std::int64_t u) {
    const double limit = edge_length[unknowns.vertex[u]];
    const double length = own.row(u).norm();
    if (!(length > limit)) {
      return 0;
    }
    step.row(u) -= (1 - limit / length) * own.row(u);
    return 1;
  });
  return static_cast<std::int64_t>(shortened);
}

}  // namespace ibmfair
