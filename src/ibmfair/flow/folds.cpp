#include "ibmfair/flow/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Of two triangles with these double area vectors, cos(theta) = -<n0, n1> > cos(fold_angle),
/// without a square root. `agree` is 1, or -1 where their orientations do not.
bool is_folded(const Vec3& N0, const Vec3& N1, double agree) {
  static const double cos_squared = std::pow(std::cos(fold_angle), 2);
  const double dot = agree * N0.dot(N1);
  if (dot > 0) {  // nearly always
    return false;
  }
  const double scale = N0.squaredNorm() * N1.squaredNorm();
  return !(scale > 0) || dot * dot > cos_squared * scale;
}

double agreement(const Topology& topology, Index h) {
  const Index second = topology.hinge_triangles(h, 1);
  return runs_along(topology.F, second, topology.H(h, 1), topology.H(h, 0)) ? 1 : -1;
}

}  // namespace

std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology) {
  const Triangles& F = topology.F;
  std::vector<Vec3> normals(static_cast<std::size_t>(F.rows()));
  parallel_for(F.rows(), [&](std::int64_t t) {
    normals[t] = double_area_vector(X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2)));
  });
  std::vector<std::uint8_t> folded(static_cast<std::size_t>(topology.H.rows()));
  parallel_for(topology.H.rows(), [&](std::int64_t h) {
    const auto t = topology.hinge_triangles.row(h);
    folded[h] = is_folded(normals[t[0]], normals[t[1]], agreement(topology, h)) ? 1 : 0;
  });
  return folded;
}

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
      hinges_.push_back({number_of(topology.hinge_triangles(h, 0)),
                         number_of(topology.hinge_triangles(h, 1)), agreement(topology, h)});
    }
  }
  normals_.resize(triangles_.size());
  folded_.resize(hinges_.size());
  find_normals(X);
  for (const Hinge& hinge : hinges_) {
    known_.push_back(is_folded_now(hinge) ? 1 : 0);
  }
}

std::vector<Index> FoldWatch::new_folds(const Points& X) {
  find_normals(X);
  parallel_for(static_cast<std::int64_t>(hinges_.size()), [&](std::int64_t i) {
    folded_[i] = !known_[i] && is_folded_now(hinges_[i]) ? 1 : 0;
  });
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

bool FoldWatch::is_folded_now(const Hinge& hinge) const {
  return is_folded(normals_[hinge.first], normals_[hinge.second], hinge.agree);
}

}  // namespace ibmfair
