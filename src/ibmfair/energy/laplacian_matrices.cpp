#include "ibmfair/energy/laplacian_matrices.h"

#include <Eigen/SparseCore>

#include "ibmfair/energy/vertex_triangles.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

/// A symmetric matrix, assembled from the contributions of triangles.
class TriangleSum {
 public:
  explicit TriangleSum(Index size) : size_(size) {
    for (Index i = 0; i < size; ++i) {
      add(i, i, 0);
    }
  }

  void add(Index i, Index j, double value) {
    entries_.emplace_back(std::max(i, j), std::min(i, j), value);
  }

  /// Adds the term weight (u_i - u_j)^2 of the quadratic form.
  void add_difference(Index i, Index j, double weight) {
    add(i, i, weight);
    add(j, j, weight);
    add(i, j, i == j ? -2 * weight : -weight);
  }

  SymmetricMatrix matrix() const {
    Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t> sum(size_, size_);
    sum.setFromTriplets(entries_.begin(), entries_.end());
    return {{sum.outerIndexPtr(), sum.outerIndexPtr() + size_ + 1},
            {sum.innerIndexPtr(), sum.innerIndexPtr() + sum.nonZeros()},
            {sum.valuePtr(), sum.valuePtr() + sum.nonZeros()}};
  }

 private:
  Index size_;
  std::vector<Eigen::Triplet<double, std::int64_t>> entries_;
};

/// The numbers that occur in the table, increasing. `place` gets the position of each of 0 .. count
/// - 1 among them, or -1.
std::vector<Index> occurring(const Triangles& table, Index count, std::vector<Index>& place) {
  place.assign(static_cast<std::size_t>(count), -1);
  for (const Index i : table.reshaped()) {
    place[i] = 0;
  }
  std::vector<Index> nodes;
  for (Index i = 0; i < count; ++i) {
    if (place[i] == 0) {
      place[i] = static_cast<Index>(nodes.size());
      nodes.push_back(i);
    }
  }
  return nodes;
}

void make_identity(SymmetricMatrix& M) {
  TriangleSum sum(static_cast<Index>(M.size()));
  for (Index i = 0; i < M.size(); ++i) {
    sum.add(i, i, 1);
  }
  M = sum.matrix();
}

}  // namespace

LaplacianMatrices edge_matrices(const Points& X, const Topology& topology, const MassMatrix& mass) {
  const Triangles F = usable_triangles(topology), sides = usable_sides(topology);
  LaplacianMatrices result;
  result.edge_based = true;
  std::vector<Index> place;
  result.nodes = occurring(sides, static_cast<Index>(topology.E.rows()), place);
  TriangleSum L(static_cast<Index>(result.nodes.size())), M = L;
  for (Index t = 0; t < F.rows(); ++t) {
    const TriangleShape<double> shape =
        triangle_shape(X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2)));
    for (int i = 0; i < 3; ++i) {
      L.add_difference(place[sides(t, next(i))], place[sides(t, previous(i))], 2 * shape.cot[i]);
      M.add(place[sides(t, i)], place[sides(t, i)], shape.area / 3);
    }
  }
  result.L = L.matrix();
  result.M = M.matrix();
  if (mass.kind == MassMatrix::Kind::identity) {
    make_identity(result.M);
  }
  return result;
}

LaplacianMatrices vertex_matrices(const Points& X, const Topology& topology,
                                  const EnergyOptions& options, const VertexLaplacian& laplacian,
                                  const MassMatrix& mass) {
  VertexTriangles triangles(topology, laplacian, mass, options, topology.usable);
  triangles.measure(X);
  const Triangles& F = triangles.corners();
  LaplacianMatrices result;
  std::vector<Index> place;
  result.nodes = occurring(usable_triangles(topology), topology.vertex_count, place);
  TriangleSum L(static_cast<Index>(result.nodes.size())), M = L;
  for (Index t = 0; t < F.rows(); ++t) {
    const TriangleShape<double>& shape = triangles.shapes()[t];
    const auto& [edge, corner] = triangles.terms()[t];
    const ByCorner<double> mixed = mass.shares.value(shape);
    for (int i = 0; i < 3; ++i) {
      const Index v = place[F(t, i)], u = place[F(t, next(i))], w = place[F(t, previous(i))];
      L.add_difference(u, w, edge[i]);
      if (mass.kind == MassMatrix::Kind::consistent) {
        M.add(v, v, shape.area / 6);
        M.add(u, w, shape.area / 12);
      } else {
        M.add(v, v, topology.kind[F(t, i)] == VertexKind::interior ? corner[i] : mixed[i]);
      }
    }
  }
  result.L = L.matrix();
  result.M = M.matrix();
  if (mass.kind == MassMatrix::Kind::identity) {
    make_identity(result.M);
  }
  return result;
}

std::vector<Index> joined_parts(const LaplacianMatrices& matrices) {
  const SymmetricMatrix& L = matrices.L;
  UnionFind parts(static_cast<Index>(L.size()));
  for (Index j = 0; j < L.size(); ++j) {
    for (std::int64_t k = L.column_first[j]; k < L.column_first[j + 1]; ++k) {
      parts.unite(j, static_cast<Index>(L.row[k]));
    }
  }
  std::vector<Index> part(static_cast<std::size_t>(L.size()));
  Index count = 0;
  for (Index i = 0; i < L.size(); ++i) {
    part[i] = parts.find(i) == i ? count++ : part[parts.find(i)];
  }
  return part;
}

}  // namespace ibmfair
