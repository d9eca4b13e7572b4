#include "ibmfair/flow/steps/folds.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// Whether two triangles with these double area vectors have a dihedral angle theta < angle:
/// cos(theta) = -<n0, n1> > cos(angle), without a square root. `turned`: their orientations
/// disagree.
bool is_folded(const Vec3& N0, const Vec3& N1, bool turned, double cos_squared) {
  const double dot = turned ? -N0.dot(N1) : N0.dot(N1);
  if (dot > 0) {  // nearly always
    return false;
  }
  const double scale = N0.squaredNorm() * N1.squaredNorm();
  return !(scale > 0) || dot * dot > cos_squared * scale;
}

double cos_squared(double angle) {
  const double cosine = std::cos(angle);
  return cosine * cosine;
}

bool is_turned(const Topology& topology, Index h) {
  const Index second = topology.hinge_triangles(h, 1);
  return !runs_along(topology.F, second, topology.H(h, 1), topology.H(h, 0));
}

}  // namespace

std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology, double angle) {
  std::vector<Vec3> normals(static_cast<std::size_t>(topology.F.rows()));
  parallel_for(topology.F.rows(),
               [&](std::int64_t t) { normals[t] = double_area_vector(X, topology.F, t); });
  std::vector<std::uint8_t> folded(static_cast<std::size_t>(topology.H.rows()));
  const double limit = cos_squared(angle);
  parallel_for(topology.H.rows(), [&](std::int64_t h) {
    const auto t = topology.hinge_triangles.row(h);
    const bool turned = is_turned(topology, static_cast<Index>(h));
    folded[h] = is_folded(normals[t[0]], normals[t[1]], turned, limit) ? 1 : 0;
  });
  return folded;
}

double least_turn(double angle) {
  // For a slightly larger angle, because the energy and is_folded() round differently.
  return 1 + std::cos(1.01 * angle);
}

FoldWatch::FoldWatch(const Points& X, const Topology& topology, const Unknowns& unknowns)
    : topology_(topology), unknowns_(unknowns), known_(folded_hinges(X, topology)) {}

void FoldWatch::list_hinges() {
  hinges_ = indices_where(topology_.H.rows(), [&](Index h) {
    const auto x = topology_.H.row(h);
    return !known_[h] &&
           std::any_of(x.begin(), x.end(), [&](Index v) { return unknowns_.unknown[v] >= 0; });
  });
  std::vector<std::uint8_t> listed(static_cast<std::size_t>(topology_.F.rows()), 0);
  turned_.reserve(hinges_.size());
  for (const Index h : hinges_) {
    turned_.push_back(is_turned(topology_, h) ? 1 : 0);
    for (const Index t : topology_.hinge_triangles.row(h)) {
      listed[t] = 1;
    }
  }
  triangles_ = indices_where(topology_.F.rows(), [&](Index t) { return listed[t] != 0; });
  folded_.resize(hinges_.size());
  normals_.resize(listed.size());
}

std::vector<Index> FoldWatch::new_folds(const Points& X, const std::vector<std::uint8_t>& near) {
  if (normals_.empty()) {
    list_hinges();
  }
  find_normals(X, near);
  parallel_for(static_cast<std::int64_t>(hinges_.size()), [&](std::int64_t i) {
    const bool is_near = near.empty() || near[topology_.H(hinges_[i], 0)] != 0;
    folded_[i] = is_near && is_folded_now(i) ? 1 : 0;
  });
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    if (folded_[i]) {
      const auto x = topology_.H.row(hinges_[i]);
      vertices.insert(vertices.end(), x.begin(), x.end());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Updates the normals of the triangles of all hinges with a near vertex.
void FoldWatch::find_normals(const Points& X, const std::vector<std::uint8_t>& near) {
  parallel_for(static_cast<std::int64_t>(triangles_.size()), [&](std::int64_t i) {
    const auto x = topology_.F.row(triangles_[i]);
    if (near.empty() || near[x[0]] != 0 || near[x[1]] != 0 || near[x[2]] != 0) {
      normals_[triangles_[i]] = double_area_vector(X, topology_.F, triangles_[i]);
    }
  });
}

bool FoldWatch::is_folded_now(std::size_t i) const {
  static const double limit = cos_squared(fold_angle);
  const auto t = topology_.hinge_triangles.row(hinges_[i]);
  return is_folded(normals_[t[0]], normals_[t[1]], turned_[i] != 0, limit);
}

}  // namespace ibmfair
