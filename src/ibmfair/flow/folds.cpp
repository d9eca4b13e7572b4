#include "ibmfair/flow/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// cos(theta) = -<n0, n1> > cos(fold_angle), without a square root. A triangle that lost its area
/// counts as folded.
bool is_folded(const Points& X, const std::array<Index, 4>& x) {
  static const double cos_squared = std::pow(std::cos(fold_angle), 2);
  const Vec3 x0 = X.row(x[0]), x1 = X.row(x[1]), x2 = X.row(x[2]), x3 = X.row(x[3]);
  const Vec3 N0 = double_area_vector(x0, x1, x2), N1 = double_area_vector(x1, x0, x3);
  const double dot = N0.dot(N1), scale = N0.squaredNorm() * N1.squaredNorm();
  return !(scale > 0) || (dot < 0 && dot * dot > cos_squared * scale);
}

}  // namespace

FoldWatch::FoldWatch(const Points& X, const Topology& topology, const Unknowns& unknowns) {
  for (const auto x : topology.H.rowwise()) {
    if (std::any_of(x.begin(), x.end(), [&](Index v) { return unknowns.unknown[v] >= 0; })) {
      hinges_.push_back({x[0], x[1], x[2], x[3]});
      known_.push_back(is_folded(X, hinges_.back()) ? 1 : 0);
    }
  }
  folded_.resize(hinges_.size());
}

std::vector<Index> FoldWatch::new_folds(const Points& X) {
  parallel_for(static_cast<std::int64_t>(hinges_.size()), [&](std::int64_t i) {
    folded_[i] = !known_[i] && is_folded(X, hinges_[i]) ? 1 : 0;
  });
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    if (folded_[i]) {
      vertices.insert(vertices.end(), hinges_[i].begin(), hinges_[i].end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace ibmfair
