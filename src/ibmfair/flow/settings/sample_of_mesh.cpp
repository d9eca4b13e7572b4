#include "ibmfair/flow/settings/sample_of_mesh.h"

#include <algorithm>
#include <utility>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// Marks `count` vertices around a seed, ring by ring, or fewer if fewer are connected with the
/// seed. Returns the number of marked vertices.
std::size_t grow(const Topology& topology, Index seed, std::size_t count,
                 std::vector<std::uint8_t>& taken) {
  std::vector<Index> queue{seed};
  taken[seed] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Index t : topology.stars[queue[next]]) {
      for (const Index v : topology.F.row(t)) {
        if (!taken[v] && queue.size() < count) {
          taken[v] = 1;
          queue.push_back(v);
        }
      }
    }
  }
  return queue.size();
}

/// Flags (#V) of the vertices of the sample. Seeds are spread over the list `free` of vertices that
/// move. If a patch stays too small, another patch starts further on in the list.
std::vector<std::uint8_t> sampled(const Topology& topology, const std::vector<Index>& free,
                                  std::size_t count) {
  constexpr std::size_t patches = choice_tuning.cutoff.patches;
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(topology.vertex_count), 0);
  const std::size_t in_patch = (count + patches - 1) / patches;
  std::size_t all = 0;
  for (std::size_t p = 0; p < patches; ++p) {
    std::size_t wanted = std::min(in_patch, count - all);
    const std::size_t first = (2 * p + 1) * free.size() / (2 * patches);
    for (std::size_t i = 0; i < free.size() && wanted > 0; ++i) {
      if (const Index seed = free[(first + i) % free.size()]; !taken[seed]) {
        const std::size_t grown = grow(topology, seed, wanted, taken);
        wanted -= grown;
        all += grown;
      }
    }
  }
  return taken;
}

/// Flags (#V of the sample) of the vertices near the rims where the sample was cut out of the mesh.
std::vector<std::uint8_t> near_rims(const Topology& whole, const LocalMesh& sample,
                                    const std::vector<std::uint8_t>& taken, int felt_rings) {
  std::vector<std::uint8_t> near(sample.vertex.size());
  std::transform(sample.vertex.begin(), sample.vertex.end(), near.begin(), [&](Index v) {
    const auto star = whole.stars[v];
    return std::any_of(star.begin(), star.end(), [&](Index t) {
      const auto x = whole.F.row(t);
      return !(taken[x[0]] && taken[x[1]] && taken[x[2]]);
    });
  });
  for (int rings = 1; rings < felt_rings; ++rings) {
    near = grow_one_ring(sample.topology, near);
  }
  return near;
}

}  // namespace

MeshSample sample_of_mesh(const Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                          const SampleSize& size) {
  const std::vector<Index> free =
      indices_where(topology.vertex_count, [&](Index v) { return fixed[v] == 0; });
  const std::vector<std::uint8_t> taken =
      sampled(topology, free, std::min(free.size(), static_cast<std::size_t>(size.vertices)));
  std::vector<Index> vertices =
      indices_where(topology.vertex_count, [&](Index v) { return taken[v] != 0; });
  const std::vector<Index> triangles =
      indices_where(static_cast<Index>(topology.F.rows()), [&](Index t) {
        return taken[topology.F(t, 0)] && taken[topology.F(t, 1)] && taken[topology.F(t, 2)];
      });
  std::vector<Index> place(static_cast<std::size_t>(topology.vertex_count), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    place[vertices[i]] = static_cast<Index>(i);
  }
  LocalMesh sample = some_of_mesh(X, topology, std::move(vertices), triangles, place);
  sample.fixed = fixed_vertices(sample.topology, BoundaryCondition::fixed);
  for (std::size_t i = 0; i < sample.vertex.size(); ++i) {
    sample.fixed[i] |= fixed[sample.vertex[i]];
  }
  sample.options = options;
  take_lists(options, sample.vertex, triangles, sample.options);
  const std::vector<std::uint8_t> near = near_rims(topology, sample, taken, size.felt_rings);
  std::vector<std::uint8_t> inner(near.size());
  for (std::size_t i = 0; i < inner.size(); ++i) {
    inner[i] = !near[i] && !sample.fixed[i];
  }
  return {std::move(sample), std::move(inner)};
}

}  // namespace ibmfair
