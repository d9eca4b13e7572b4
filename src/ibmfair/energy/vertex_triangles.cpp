#include "ibmfair/energy/vertex_triangles.h"

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

std::span<const Index> entries(const auto& table) {
  return {table.data(), static_cast<std::size_t>(table.size())};
}

PerVertex checked(const std::vector<double>& weights, Index vertex_count) {
  PerVertex result = PerVertex::Map(weights.data(), static_cast<Eigen::Index>(weights.size()));
  if (result.size() != vertex_count || !result.allFinite()) {
    throw BadOption(
        fmt::format("there must be a finite weight for each of the {} vertices", vertex_count));
  }
  return result;
}

Triangles usable_rows(const Topology& topology, const Triangles& table) {
  return table(indices_where(table.rows(), [&](Index t) { return topology.usable[t]; }),
               Eigen::all);
}

}  // namespace

Triangles usable_triangles(const Topology& topology) {
  return usable_rows(topology, topology.F);
}

Triangles usable_sides(const Topology& topology) {
  Triangles sides = Triangles::Constant(topology.F.rows(), 3, -1);
  for (Index e = 0; e < topology.E.rows(); ++e) {
    for (const Index t : topology.edge_triangles[e]) {
      const Index apex = opposite_vertex(topology.F, t, topology.E(e, 0), topology.E(e, 1));
      sides(t, place_of(topology.F, t, apex)) = e;
    }
  }
  return usable_rows(topology, sides);
}

VertexTriangles::VertexTriangles(const Topology& topology, const VertexLaplacian& laplacian,
                                 const MassMatrix& mass, const EnergyOptions& options,
                                 const std::vector<std::uint8_t>& kept)
    : edge_weights_(laplacian.edge_weights), shares_(mass.shares), mesh_shares_(mass.shares) {
  if (laplacian.flips) {
    shares_ = triangle_formula<CircumcentricShares>;
    delaunay_ = std::make_unique<IntrinsicDelaunay>(topology);
    edges_ = topology.E;
    edge_ends_ = positions_by_value(entries(edges_), topology.vertex_count);
    places_.first.resize(static_cast<std::size_t>(topology.vertex_count) + 1);
    return;
  }
  const auto rows = indices_where(topology.F.rows(), [&](Index t) { return kept[t]; });
  corners_ = topology.F(rows, Eigen::all);
  shapes_.resize(static_cast<std::size_t>(corners_.rows()));
  places_ = positions_by_value(entries(corners_), topology.vertex_count);
  if (laplacian.circle_weights) {
    if (options.vertex_weights.empty()) {
      circles_ = std::make_unique<CircleWeights>(topology);
    } else {
      weights_ = checked(options.vertex_weights, topology.vertex_count);
    }
  }
  if (laplacian.directions) {
    directions_.reserve(rows.size());
    for (const Index t : rows) {
      directions_.push_back(options.material_directions[t]);
    }
  }
}

TriangleTerms VertexTriangles::terms_at(const TriangleShape<double>& shape) const {
  return {edge_weights_.value(shape), shares_.value(shape)};
}

void VertexTriangles::measure(const Points& X) {
  if (circles_) {
    weights_ = circles_->at(X);
  }
  if (delaunay_) {
    delaunay_->triangulate(X);
    places_ = positions_by_value(entries(corners()), static_cast<Index>(X.rows()));
  } else {
    parallel_for(corners_.rows(), [&](std::int64_t t) {
      const auto x = corners_.row(t);
      TriangleShape<double>& shape = shapes_[t];
      shape = triangle_shape(X.row(x[0]), X.row(x[1]), X.row(x[2]));
      if (weights_.size() > 0) {
        shape.weight = {weights_[x[0]], weights_[x[1]], weights_[x[2]]};
      }
      shape.direction = directions_.empty() ? nullptr : &directions_[t];
    });
  }
  terms_.resize(shapes().size());
  parallel_for(corners().rows(), [&](std::int64_t t) { terms_[t] = terms_at(shapes()[t]); });
}

/// The material direction of the triangle with these vertices, with the rates in their order.
MaterialDirection VertexTriangles::direction_of(Index v0, Index v1, Index v2) const {
  MaterialDirection result{};
  around(v0, [&](Index t, int i) {
    const int j = next(i), k = previous(i);
    const bool same = corners_(t, j) == v1 && corners_(t, k) == v2;
    if (same || (corners_(t, j) == v2 && corners_(t, k) == v1)) {
      const auto& [rate, factor] = directions_[t];
      result = {{rate[i], rate[same ? j : k], rate[same ? k : j]}, factor};
    }
  });
  return result;
}

TriangleTerms VertexTriangles::terms_of(const Points& X, Index v0, Index v1, Index v2) const {
  TriangleShape<double> shape = triangle_shape(X.row(v0), X.row(v1), X.row(v2));
  if (weights_.size() > 0) {
    shape.weight = {weights_[v0], weights_[v1], weights_[v2]};
  }
  MaterialDirection direction;
  if (!directions_.empty()) {
    direction = direction_of(v0, v1, v2);
    shape.direction = &direction;
  }
  return {edge_weights_.value(shape), mesh_shares_.value(shape)};
}

TriangleSlopes VertexTriangles::slopes(Index t, const TriangleTerms& by_terms) const {
  const TriangleShape<MetricJet> shape = differentiated(shapes()[t]);
  const ByCorner<MetricJet> edge = edge_weights_.jet(shape), corner = shares_.jet(shape);
  TriangleSlopes result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result.by_squared[j] +=
          by_terms.edge[i] * edge[i].derivative[j] + by_terms.corner[i] * corner[i].derivative[j];
      result.by_weight[j] += by_terms.edge[i] * edge[i].derivative[3 + j];
    }
  }
  return result;
}

void VertexTriangles::pull_back(const Points& X, std::vector<TriangleSlopes>& slopes,
                                Points& G) const {
  if (circles_) {
    PerVertex by_weight(X.rows());
    parallel_for(X.rows(), [&](std::int64_t v) {
      double sum = 0;
      around(static_cast<Index>(v), [&](Index t, int i) { sum += slopes[t].by_weight[i]; });
      by_weight[v] = sum;
    });
    circles_->pull_back(X, by_weight, G);
  }
  if (!delaunay_) {
    parallel_for(X.rows(), [&](std::int64_t v) {
      Vec3 g = Vec3::Zero();
      around(static_cast<Index>(v), [&](Index t, int i) {
        const int j = next(i), k = previous(i);
        g += 2 * slopes[t].by_squared[k] * (X.row(v) - X.row(corners_(t, j)));
        g += 2 * slopes[t].by_squared[j] * (X.row(v) - X.row(corners_(t, k)));
      });
      G.row(v) += g;
    });
    return;
  }
  std::vector<double> by_squared(static_cast<std::size_t>(edges_.rows()), 0);
  const Triangles& sides = delaunay_->sides();
  for (Index t = 0; t < sides.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      by_squared[sides(t, i)] += slopes[t].by_squared[i];
    }
  }
  delaunay_->pull_back(by_squared);
  parallel_for(X.rows(), [&](std::int64_t v) {
    Vec3 g = Vec3::Zero();
    for (const Index end : edge_ends_[static_cast<Index>(v)]) {
      g += 2 * by_squared[end / 2] * (X.row(v) - X.row(edges_.data()[end ^ 1]));
    }
    G.row(v) += g;
  });
}

}  // namespace ibmfair
