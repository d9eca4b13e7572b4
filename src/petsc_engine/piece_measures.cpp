#include "petsc_engine/piece_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ibmfair/base/angle.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::petsc {
namespace {

double volume(const MeshPiece& piece, const Points& X, const PetscParts& parts) {
  Vec3 centre = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    centre[c] =
        parts.sum(X.col(c).head(piece.own).sum()) / static_cast<double>(piece.vertices.total);
  }
  double sum = 0;
  for (Index t = 0; t < piece.F.rows(); ++t) {
    if (piece.own_triangle[t]) {
      const Vec3 a = X.row(piece.F(t, 0)), b = X.row(piece.F(t, 1)), c = X.row(piece.F(t, 2));
      sum += (a - centre).dot((b - centre).cross(c - centre)) / 6;
    }
  }
  return parts.sum(sum);
}

double smallest_angle(const Topology& topology, const MeshPiece& piece, const Points& X,
                      const PetscParts& parts) {
  const Eigen::VectorXd angles = smallest_angles(X, topology.F);
  double largest_negative = -std::numbers::pi;
  for (Index t = 0; t < angles.size(); ++t) {
    if (piece.own_triangle[t]) {
      largest_negative = std::max(largest_negative, -angles[t]);
    }
  }
  return degrees(-parts.max(largest_negative));
}

std::int64_t folds(const Topology& topology, const Points& X, const PetscParts& parts) {
  const std::vector<std::uint8_t> folded = folded_hinges(X, topology);
  double count = 0;
  for (Index h = 0; h < topology.H.rows(); ++h) {
    count += folded[h] ? own_share({topology.H.row(h).data(), 4}, parts) : 0;
  }
  return std::llround(parts.sum(count));
}

/// The numbers of all ranks, sorted, on the first rank.
std::vector<Index> gathered(const Communicator& comm, const std::vector<Index>& numbers) {
  std::vector<Index> all = comm.gather_to_first(numbers);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

commands::MeshStatistics mesh_statistics(const MeshPiece& piece, const Points& X,
                                         const Topology& topology, const FlowOptions& options,
                                         const PetscParts& parts) {
  EnergyOptions energy = options.energy_options();
  energy.own_vertices = parts.own_vertices();
  energy.own_triangles = parts.own_triangles();
  commands::MeshStatistics statistics;
  statistics.energy =
      parts.sum(bending_model(options.laplacian).create(topology, energy)->energy(X));
  statistics.area = surface_area(X, topology, parts);
  statistics.volume = volume(piece, X, parts);
  statistics.smallest_angle = smallest_angle(topology, piece, X, parts);
  statistics.folds = folds(topology, X, parts);
  return statistics;
}

Topology gathered_defects(const Communicator& comm, const Topology& topology,
                          const MeshPiece& piece) {
  const auto own_triangles = [&](const std::vector<Index>& list) {
    std::vector<Index> numbers;
    for (const Index t : list) {
      if (piece.own_triangle[t]) {
        numbers.push_back(piece.triangle[t]);
      }
    }
    return gathered(comm, numbers);
  };
  Topology whole;
  const Defects& defects = topology.defects;
  whole.defects.repeated_corner = own_triangles(defects.repeated_corner);
  whole.defects.zero_area = own_triangles(defects.zero_area);
  whole.defects.duplicate = own_triangles(defects.duplicate);
  std::vector<Index> bow_ties;
  for (const Index v : defects.bow_tie_vertices) {
    if (v < piece.own) {
      bow_ties.push_back(piece.vertex[v]);
    }
  }
  whole.defects.bow_tie_vertices = gathered(comm, bow_ties);
  std::vector<std::array<Index, 2>> edges;
  for (const Index e : defects.non_manifold_edges) {
    Index first = topology.E(e, 0), second = topology.E(e, 1);
    if (piece.vertex[first] > piece.vertex[second]) {
      std::swap(first, second);
    }
    if (first < piece.own) {  // otherwise another rank reports the edge
      edges.push_back({piece.vertex[first], piece.vertex[second]});
    }
  }
  edges = comm.gather_to_first(edges);
  std::sort(edges.begin(), edges.end());
  whole.E.resize(std::ssize(edges), 2);
  for (Index e = 0; e < whole.E.rows(); ++e) {
    whole.E.row(e) << edges[e][0], edges[e][1];
    whole.defects.non_manifold_edges.push_back(e);
  }
  return whole;
}

}  // namespace ibmfair::petsc
