#include "ibmfair/flow/steps/free_rims.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "ibmfair/base/parallel.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The direction that most of the area at v faces, of unit length: the normal of the only triangle,
/// or the mean of the normals if the surface is nearly flat.
Vec3 facing(Index v, const Points& X, const Topology& topology) {
  Eigen::Matrix3d squared_normals = Eigen::Matrix3d::Zero();
  for (const Index t : topology.stars[v]) {
    const Vec3 N = double_area_vector(X, topology.F, t);
    const double length = N.norm();
    if (length > 0) {
      squared_normals += N * (N / length).transpose();
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions;
  directions.computeDirect(squared_normals / squared_normals.norm());
  return directions.eigenvectors().col(2);  // of the largest eigenvalue
}

Vec3 mean_of(std::span<const Index> vertices, const Points& X) {
  Vec3 sum = Vec3::Zero();
  for (const Index q : vertices) {
    sum += X.row(q);
  }
  return sum / static_cast<double>(vertices.size());
}

/// The vertices that share a triangle with v, in increasing order.
std::vector<Index> neighbours_of(Index v, const Topology& topology) {
  std::vector<Index> all;
  for (const Index t : topology.stars[v]) {
    for (const Index q : topology.F.row(t)) {
      if (q != v) {
        all.push_back(q);
      }
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

FreeRims::FreeRims(const Points& start, const Topology& topology, const Unknowns& unknowns)
    : topology_(topology), unknown_count_(unknowns.size()) {
  for (Index u = 0; u < unknowns.size(); ++u) {
    const Index v = unknowns.vertex[u];
    if (topology.kind[v] == VertexKind::boundary) {
      vertices_.push_back(v);
      unknowns_.push_back(u);
      const std::vector<Index> around = neighbours_of(v, topology);
      neighbours_.value.insert(neighbours_.value.end(), around.begin(), around.end());
      neighbours_.first.push_back(static_cast<std::int64_t>(neighbours_.value.size()));
    }
  }
  reach_.resize(neighbours_.size());
  parallel_for(reach_.size(), [&](std::int64_t i) {
    const Vec3 offset = start.row(vertices_[i]).transpose() - mean_of(neighbours_[i], start);
    reach_[i] = tuning.rims.growth * offset.norm();
  });
}

void FreeRims::find_normals(const Points& X) {
  normals_.resize(static_cast<Eigen::Index>(vertices_.size()), 3);
  parallel_for(normals_.rows(),
               [&](std::int64_t i) { normals_.row(i) = facing(vertices_[i], X, topology_); });
}

void FreeRims::project(Points& rows) const {
  parallel_for(normals_.rows(), [&](std::int64_t i) {
    const Vec3 n = normals_.row(i), row = rows.row(unknowns_[i]);
    rows.row(unknowns_[i]) = n.dot(row) * n;
  });
}

bool FreeRims::pull_in(const Points& X, Points& move) const {
  bool moves = false;
  for (Index i = 0; i < neighbours_.size(); ++i) {
    const Vec3 inward = mean_of(neighbours_[i], X) - X.row(vertices_[i]).transpose();
    const double distance = inward.norm();
    if (distance > reach_[i]) {
      if (!moves) {
        move = Points::Zero(unknown_count_, 3);
        moves = true;
      }
      move.row(unknowns_[i]) = (1 - reach_[i] / distance) * inward;
    }
  }
  return moves;
}

}  // namespace ibmfair
