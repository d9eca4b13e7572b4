#include "ibmfair/flow/local_mesh.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_blocks.h"

namespace ibmfair {
namespace {

/// Vertices of a mesh that a processor's cache holds well enough.
constexpr Index fits_the_cache = 30000;

/// Vertices whose numbers are not more than this apart are close in memory: scanned lines are not
/// much longer. Hardly an edge of an ordered mesh is, and nine in ten of one in no order, which
/// takes two to three times as long. In a mesh that was subdivided up to three in four are, but in
/// an order that the processor foresees: that would save a tenth, for a second topology in memory.
constexpr Index near_in_memory = 2048;
constexpr double most_far = 0.8;  // of the edges

/// The vertices block by block, those without a triangle last.
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

/// Rows, or entries, in another order; none stay none.
template <class List>
List reordered(const List& list, const std::vector<Index>& order) {
  List in_order = list;
  if (list.size() > 0) {
    parallel_for(static_cast<std::int64_t>(order.size()), [&](std::int64_t i) {
      if constexpr (requires { in_order.row(i); }) {
        in_order.row(i) = list.row(order[i]);
      } else {
        in_order[i] = list[order[i]];
      }
    });
  }
  return in_order;
}

/// The triangles, over vertices at new places, by the first of these.
std::vector<Index> by_first_vertex(const Triangles& F, const std::vector<Index>& place) {
  std::vector<Index> first(static_cast<std::size_t>(F.rows()));
  parallel_for(F.rows(), [&](std::int64_t t) {
    first[t] = std::min({place[F(t, 0)], place[F(t, 1)], place[F(t, 2)]});
  });
  return positions_by_value(first, static_cast<Index>(place.size())).value;
}

/// The same connectivity, its vertices at new places and its triangles in another order.
Topology with_new_numbers(const Topology& topology, const std::vector<Index>& place,
                          const std::vector<Index>& triangle) {
  Triangles F = reordered(topology.F, triangle);
  for (Index& corner : F.reshaped()) {
    corner = place[corner];
  }
  const std::vector<Index> place_of_triangle = inverse(triangle);
  std::vector<Index> zero_area = topology.defects.zero_area;
  for (Index& t : zero_area) {
    t = place_of_triangle[t];
  }
  std::sort(zero_area.begin(), zero_area.end());
  return build_topology(topology.vertex_count, std::move(F), std::move(zero_area));
}

}  // namespace

bool is_scattered(const Topology& topology) {
  if (topology.vertex_count < fits_the_cache || !topology.orientable) {
    return false;
  }
  const auto far = parallel_sum(topology.E.rows(), [&](std::int64_t e) {
    return topology.E(e, 1) - topology.E(e, 0) > near_in_memory ? 1.0 : 0.0;
  });
  return far > most_far * static_cast<double>(topology.E.rows());
}

LocalMesh local_mesh(const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& held, const FlowOptions& options) {
  std::vector<Index> order = blockwise(topology);
  const std::vector<Index> place = inverse(order);
  const std::vector<Index> triangle = by_first_vertex(topology.F, place);
  LocalMesh mesh{std::move(order), {}, with_new_numbers(topology, place, triangle), {}, options};
  mesh.X = reordered(X, mesh.vertex);
  mesh.held = reordered(held, mesh.vertex);
  mesh.options.cutoff_factor = reordered(options.cutoff_factor, mesh.vertex);
  mesh.options.spontaneous_curvature = reordered(options.spontaneous_curvature, mesh.vertex);
  mesh.options.material_axes = reordered(options.material_axes, triangle);
  return mesh;
}

}  // namespace ibmfair
