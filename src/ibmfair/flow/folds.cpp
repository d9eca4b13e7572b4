#include "ibmfair/flow/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

FoldWatch::FoldWatch(const Points& X, const Topology& topology, const Unknowns& unknowns) {
  std::vector<Index> number(static_cast<std::size_t>(topology.F.rows()), -1);
  const auto number_of = [&](Index t) {
    if (number[t] < 0) {
      number[t] = static_cast<Index>(triangles_.size());
      triangles_.push_back({topology.F(t, 0), topology.F(t, 1), topology.F(t, 2)});
    }
    return number[t];
  };
  for (Index h = 0; h < topology.H.rows(); ++h) {
    const auto x = topology.H.row(h);
    if (std::any_of(x.begin(), x.end(), [&](Index v) { return unknowns.unknown[v] >= 0; })) {
      const Index t0 = topology.hinge_triangles(h, 0), t1 = topology.hinge_triangles(h, 1);
      const bool agree = runs_along(topology.F, t1, x[1], x[0]);
      hinges_.push_back({number_of(t0), number_of(t1), agree ? 1.0 : -1.0});
    }
  }
  normals_.resize(triangles_.size());
  folded_.resize(hinges_.size());
  find_normals(X);
  for (const Hinge& hinge : hinges_) {
    known_.push_back(is_folded(hinge) ? 1 : 0);
  }
}

std::vector<Index> FoldWatch::new_folds(const Points& X) {
  find_normals(X);
  parallel_for(static_cast<std::int64_t>(hinges_.size()),
               [&](std::int64_t i) { folded_[i] = !known_[i] && is_folded(hinges_[i]) ? 1 : 0; });
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    if (folded_[i]) {
      for (const Index t : {hinges_[i].first, hinges_[i].second}) {
        vertices.insert(vertices.end(), triangles_[t].begin(), triangles_[t].end());
      }
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void FoldWatch::find_normals(const Points& X) {
  parallel_for(static_cast<std::int64_t>(triangles_.size()), [&](std::int64_t t) {
    const auto [a, b, c] = triangles_[t];
    normals_[t] = double_area_vector(X.row(a), X.row(b), X.row(c));
  });
}

/// cos(theta) = -<n0, n1> > cos(fold_angle), without a square root. A triangle that lost its area
/// counts as folded.
bool FoldWatch::is_folded(const Hinge& hinge) const {
  static const double cos_squared = std::pow(std::cos(fold_angle), 2);
  const Vec3 &N0 = normals_[hinge.first], &N1 = normals_[hinge.second];
  const double dot = hinge.agree * N0.dot(N1);
  if (dot > 0) {  // nearly always
    return false;
  }
  const double scale = N0.squaredNorm() * N1.squaredNorm();
  return !(scale > 0) || dot * dot > cos_squared * scale;
}

}  // namespace ibmfair
