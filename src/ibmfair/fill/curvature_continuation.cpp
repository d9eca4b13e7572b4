#include "ibmfair/fill/curvature_continuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include <Eigen/SparseCore>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

constexpr int rings = 4;                               // of the mesh around the rim
constexpr double wavelength = 1.5, decay_length = 10;  // in edges of the rim

/// The patch and the mesh around it. Vertices of the mesh come first, then the patch's own.
struct Neighborhood {
  Points X;
  Topology topology;
  Index own_from = 0;
};

Neighborhood neighborhood_of(const Points& X, const Topology& topology, const Patch& patch) {
  const std::vector<Index> around = vertices_around_rim(topology, patch, rings);
  std::unordered_map<Index, Index> number;
  for (const Index v : around) {
    number.emplace(v, static_cast<Index>(number.size()));
  }
  Neighborhood result;
  result.own_from = static_cast<Index>(around.size());
  result.X.resize(result.own_from + patch.own_size(), 3);
  result.X << X(around, Eigen::all), patch.X.bottomRows(patch.own_size());
  std::vector<std::array<Index, 3>> triangles;
  for (const Index v : around) {
    for (const Index t : topology.stars[v]) {
      const auto corner = topology.F.row(t);
      const bool protrudes = std::ranges::find(patch.protruding, t) != patch.protruding.end();
      // Each triangle once: from its first corner.
      if (corner[0] == v && number.contains(corner[1]) && number.contains(corner[2]) &&
          !protrudes) {
        triangles.push_back({number[v], number[corner[1]], number[corner[2]]});
      }
    }
  }
  for (Index t = 0; t < patch.net.size(); ++t) {
    std::array<Index, 3> corner = patch.net[t];
    for (Index& v : corner) {
      v = v < patch.own_from ? number.at(patch.mesh_vertex[v])
                             : v - patch.own_from + result.own_from;
    }
    triangles.push_back(corner);
  }
  Triangles F(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    F.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  result.topology = build_topology(result.X, std::move(F));
  return result;
}

Sparse both_triangles(const SymmetricMatrix& lower) {
  const Eigen::Map<const Sparse> map(
      lower.size(), lower.size(), static_cast<std::int64_t>(lower.value.size()),
      lower.column_first.data(), lower.row.data(), lower.value.data());
  return map.selfadjointView<Eigen::Lower>();
}

SymmetricMatrix lower_triangle(const Sparse& matrix) {
  const Sparse lower = matrix.triangularView<Eigen::Lower>();
  return {{lower.outerIndexPtr(), lower.outerIndexPtr() + lower.cols() + 1},
          {lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros()},
          {lower.valuePtr(), lower.valuePtr() + lower.nonZeros()}};
}

/// [A + B, -B P; -P^T B, P^T B P], where P selects the rows from number `first` on.
Sparse joined(const Sparse& A, const Sparse& B, Index first) {
  const std::int64_t n = A.rows();
  std::vector<Eigen::Triplet<double, std::int64_t>> entries;
  const auto visit = [](const Sparse& matrix, const auto& add) {
    for (std::int64_t j = 0; j < matrix.outerSize(); ++j) {
      for (Sparse::InnerIterator entry(matrix, j); entry; ++entry) {
        add(entry.row(), j, entry.value());
      }
    }
  };
  visit(A, [&](std::int64_t i, std::int64_t j, double a) { entries.emplace_back(i, j, a); });
  visit(B, [&](std::int64_t i, std::int64_t j, double b) {
    entries.emplace_back(i, j, b);
    if (i >= first) {
      entries.emplace_back(n + i - first, j, -b);
    }
    if (i >= first && j >= first) {
      entries.emplace_back(n + i - first, n + j - first, b);
    }
  });
  Sparse result(2 * n - first, 2 * n - first);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

void continue_curvature(const Points& X, const Topology& topology, Patch& patch) {
  if (patch.own_size() == 0) {
    return;
  }
  const Neighborhood part = neighborhood_of(X, topology, patch);
  const LaplacianMatrices matrices =
      bending_model("intrinsic-delaunay").matrices(part.X, part.topology, EnergyOptions());
  const std::int64_t n = part.X.rows();
  if (matrices.L.size() != n) {
    return;
  }
  // In units of the rim's mean edge.
  const double edge = mean_rim_edge_length(patch);
  const Sparse L = both_triangles(matrices.L);
  const Eigen::VectorXd mass = both_triangles(matrices.M).diagonal() / (edge * edge);
  const Sparse ML = mass.cwiseInverse().asDiagonal() * L;
  const Sparse A = Sparse(ML.transpose()) * Sparse(L * ML);  // L M^-1 L M^-1 L
  Sparse B = L;
  B.diagonal() += mass / (decay_length * decay_length);
  B *= std::pow(2 * std::numbers::pi / wavelength, 4);
  // The unknowns are the changes of s at all vertices and of s + r at the patch's own, from s = X.
  const SymmetricMatrix J = lower_triangle(joined(A, B, part.own_from));
  Points change = Points::Zero(J.size(), 3), place = change;
  change.topRows(n) = -(A * (part.X.rowwise() - part.X.row(0)));
  place << part.X, part.X.bottomRows(patch.own_size());
  MultifrontalCholesky cholesky{MultifrontalAnalysis(J, place)};
  cholesky.factor(J);
  cholesky.solve(change, change);
  patch.X.bottomRows(patch.own_size()) += change.bottomRows(patch.own_size());
}

}  // namespace ibmfair
