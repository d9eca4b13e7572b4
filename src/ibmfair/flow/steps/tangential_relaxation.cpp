#include "ibmfair/flow/steps/tangential_relaxation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// The length of the sum of the neighbours' normals over the sum of their lengths, for a vertex
/// with the share `left` on the edge of a wedge: two of its six neighbours lie on the edge, too.
double left_around_edge(double left) {
  return 3 * left / (2 + left);
}

/// The part of a step perpendicular to the normal, or 0 if the normal is 0.
Vec3 across(const Vec3& normal, const Vec3& step) {
  const double squared = normal.squaredNorm();
  return squared > 0 ? Vec3(step - normal * (normal.dot(step) / squared)) : Vec3(Vec3::Zero());
}

}  // namespace

TangentialRelaxation::TangentialRelaxation(const FlowProblem& problem, const RingGroups& rings)
    : topology_(problem.topology),
      unknowns_(problem.unknowns),
      parts_(problem.parts),
      rings_(rings),
      keeps_creases_(problem.options.sharp_angle > 0 || problem.options.relax_along_creases),
      crease_(problem.options.relax_along_creases ? tuning.short_cutoff.crease
                                                  : tuning.relaxation.crease),
      normals_(Points::Zero(topology_.vertex_count, 3)),
      left_(PerVertex::Zero(topology_.vertex_count)) {}

void TangentialRelaxation::moves(const Points& X, Points& move) {
  move.resize(unknowns_.size(), 3);
  run_tasks(rings_.parts(), rings_.are_worth_sharing(), [&](std::int64_t part) {
    const RingRange range(rings_, part);
    ForPart<Surroundings> around;
    find_surroundings(range, X, around);
    range.for_each([&](Index v, std::int64_t i) { take(X, v, around[i], move); });
  });
  parallel_for(static_cast<std::int64_t>(rings_.others.size()), [&](std::int64_t i) {
    const Index v = rings_.others[i];
    take(X, v, look_around(X, v), move);
  });
  parts_.refresh(normals_);
  if (keeps_creases_) {
    return;
  }
  parallel_for(move.rows(), [&](std::int64_t u) {
    const Index v = unknowns_.vertex[u];
    if (is_oriented_interior(topology_, v) && sticks_out(v)) {
      move.row(u) = look_around(X, v).half_way.xyz();
    }
  });
}

void TangentialRelaxation::take(const Points& X, Index v, const Surroundings& around,
                                Points& move) {
  normals_.row(v) = around.normal.xyz();
  left_[v] = around.normal.w;
  const Index u = unknowns_.unknown[v];
  if (u < 0 || u >= unknowns_.size()) {
    return;
  }
  const bool moves = is_oriented_interior(topology_, v);
  const bool may_have_crease = keeps_creases_ && left_[v] < tuning.relaxation.all_left;
  if (moves && may_have_crease) {
    const Vec3 step = along_creases(X, v, around.half_way.xyz());
    move.row(u) = across(normals_.row(v), step);
  } else {
    move.row(u) = moves ? around.along.xyz() : Vec3(Vec3::Zero());
  }
}

bool TangentialRelaxation::moves_at_needles(const Points& X, Points& move) {
  const std::vector<Index> thin = needles(X, topology_.F, tuning.relaxation.needle);
  if (!parts_.any(!thin.empty())) {
    return false;
  }
  Points all;
  moves(X, all);
  move = Points::Zero(all.rows(), 3);
  for (const Index t : thin) {
    for (const Index v : topology_.F.row(t)) {
      if (const Index u = unknowns_.unknown[v]; u >= 0 && u < unknowns_.size()) {
        move.row(u) = all.row(u);
      }
    }
  }
  return true;
}

Surroundings TangentialRelaxation::look_around(const Points& X, Index v) const {
  const auto ring = rings_.rings[v];
  const Vec3 x = X.row(v);
  Vec3 normal = Vec3::Zero(), toward = Vec3::Zero();
  double lengths = 0;
  for (const Index t : topology_.stars[v]) {
    const Vec3 N = double_area_vector(X, topology_.F, t);
    normal += N;
    lengths += N.norm();
  }
  for (const Index q : ring) {
    toward += X.row(q).transpose() - x;
  }
  const Vec3 half_way = 0.5 / std::max(1.0, static_cast<double>(ring.size())) * toward;
  const Vec3 along = across(normal, half_way);
  return {{normal.x(), normal.y(), normal.z(), lengths > 0 ? normal.norm() / lengths : 0},
          {half_way.x(), half_way.y(), half_way.z(), 0},
          {along.x(), along.y(), along.z(), 0}};
}

bool TangentialRelaxation::sticks_out(Index v) const {
  if (left_[v] > tuning.relaxation.little_left) {
    return false;
  }
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (const Index q : rings_.rings[v]) {
    const Vec3 N = normals_.row(q);
    sum += N;
    length += N.norm();
  }
  return sum.norm() > tuning.relaxation.more_left * left_around_edge(left_[v]) * length;
}

Vec3 TangentialRelaxation::along_creases(const Points& X, Index v, const Vec3& step) const {
  Eigen::Matrix3d squared_normals = Eigen::Matrix3d::Zero();
  for (const Index t : topology_.stars[v]) {
    const Vec3 N = double_area_vector(X, topology_.F, t);
    const double length = N.norm();
    if (length > 0) {
      const auto [a, b] = other_corners(topology_.F, t, v);
      const double cosine_side = (X.row(a) - X.row(v)).dot(X.row(b) - X.row(v));
      squared_normals += std::atan2(length, cosine_side) / (length * length) * N * N.transpose();
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions;
  directions.computeDirect(squared_normals);
  const Vec3& facing = directions.eigenvalues();  // increasing
  Vec3 along = Vec3::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vec3 direction = directions.eigenvectors().col(i);
    const double free = 1 - facing[i] / (crease_ * facing[2]);
    along += std::max(0.0, free) * direction.dot(step) * direction;
  }
  return along;
}

}  // namespace ibmfair
