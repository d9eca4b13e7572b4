#include "ibmfair/flow/passes/local_mesh.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_blocks.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// The vertices block by block; vertices without a triangle come last.
std::vector<Index> blockwise(const Topology& topology) {
  std::vector<Index> order =
      vertex_blocks(topology, std::vector<std::uint8_t>(topology.F.rows(), 1)).value;
  std::vector<std::uint8_t> listed(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const Index v : order) {
    listed[v] = 1;
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (!listed[v]) {
      order.push_back(v);
    }
  }
  return order;
}

/// The inverse of a permutation.
std::vector<Index> inverse(const std::vector<Index>& order) {
  std::vector<Index> place(order.size());
  parallel_for(static_cast<std::int64_t>(order.size()),
               [&](std::int64_t i) { place[order[i]] = static_cast<Index>(i); });
  return place;
}

/// The entries of `list` with the numbers in `order`; an empty list stays empty.
template <class List>
List picked(const List& list, const std::vector<Index>& order) {
  List result(list.size() > 0 ? order.size() : 0);
  parallel_for(static_cast<std::int64_t>(result.size()),
               [&](std::int64_t i) { result[i] = list[order[i]]; });
  return result;
}

/// The triangles in the order of their first vertex in the new numbering.
std::vector<Index> by_first_vertex(const Triangles& F, const std::vector<Index>& place) {
  std::vector<Index> first(static_cast<std::size_t>(F.rows()));
  parallel_for(F.rows(), [&](std::int64_t t) {
    first[t] = std::min({place[F(t, 0)], place[F(t, 1)], place[F(t, 2)]});
  });
  return positions_by_value(first, static_cast<Index>(place.size())).value;
}

/// The positions in `triangles` of the triangles in the sorted list `listed`.
std::vector<Index> places_of(const std::vector<Index>& listed,
                             const std::vector<Index>& triangles) {
  std::vector<Index> places;
  for (std::size_t i = 0; !listed.empty() && i < triangles.size(); ++i) {
    if (std::binary_search(listed.begin(), listed.end(), triangles[i])) {
      places.push_back(static_cast<Index>(i));
    }
  }
  return places;
}

}  // namespace

bool is_scattered(const Topology& topology) {
  if (topology.vertex_count < tuning.renumbering.fits_the_cache || !topology.orientable) {
    return false;
  }
  const auto far = parallel_sum(topology.E.rows(), [&](std::int64_t e) {
    return topology.E(e, 1) - topology.E(e, 0) > tuning.renumbering.near_in_memory ? 1.0 : 0.0;
  });
  return far > tuning.renumbering.most_far * static_cast<double>(topology.E.rows());
}

LocalMesh local_mesh(const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  std::vector<Index> order = blockwise(topology);
  const std::vector<Index> place = inverse(order);
  const std::vector<Index> triangles = by_first_vertex(topology.F, place);
  LocalMesh mesh = some_of_mesh(X, topology, std::move(order), triangles, place);
  mesh.fixed = picked(fixed, mesh.vertex);
  mesh.options = options;
  take_lists(options, mesh.vertex, triangles, mesh.options);
  return mesh;
}

LocalMesh some_of_mesh(const Points& X, const Topology& topology, std::vector<Index> vertices,
                       const std::vector<Index>& triangles, const std::vector<Index>& place) {
  Triangles F = topology.F(triangles, Eigen::all);
  for (Index& corner : F.reshaped()) {
    corner = place[corner];
  }
  LocalMesh mesh;
  mesh.X = X(vertices, Eigen::all);
  mesh.topology = build_topology(static_cast<Index>(vertices.size()), std::move(F),
                                 places_of(topology.defects.zero_area, triangles));
  mesh.fixed.assign(vertices.size(), 1);
  mesh.vertex = std::move(vertices);
  return mesh;
}

void take_lists(const FlowOptions& options, const std::vector<Index>& vertices,
                const std::vector<Index>& triangles, FlowOptions& local) {
  local.cutoff_factor = picked(options.cutoff_factor, vertices);
  local.spontaneous_curvature = picked(options.spontaneous_curvature, vertices);
  local.material_directions = picked(options.material_directions, triangles);
}

}  // namespace ibmfair
