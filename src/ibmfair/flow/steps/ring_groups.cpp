#include "ibmfair/flow/steps/ring_groups.h"

#include <algorithm>
#include <array>

#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// The length of the longest ring in a group, and the number of consecutive vertices, which are
/// close in memory, among which groups are formed. Sizes of lists: they change no result.
constexpr std::size_t longest = 12, run_length = 512;

/// The unknowns' vertices and their neighbours.
std::vector<Index> near(const Topology& topology, const Unknowns& unknowns) {
  std::vector<std::uint8_t> near(static_cast<std::size_t>(topology.vertex_count));
  for (Index v = 0; v < topology.vertex_count; ++v) {
    near[v] = unknowns.unknown[v] >= 0 ? 1 : 0;
  }
  near = grow_one_ring(topology, near);
  return indices_where(topology.vertex_count, [&](Index v) { return near[v] != 0; });
}

}  // namespace

RingGroups::RingGroups(const Topology& topology, const CompressedRows& mesh_rings,
                       const Unknowns& unknowns)
    : rings(mesh_rings) {
  const std::vector<Index> vertices = near(topology, unknowns);
  const Index last = topology.vertex_count - 1;
  const auto fits = [&](Index v) {
    const auto ring = rings[v];
    return is_ringed(topology, v) && ring.size() <= longest && v != last &&
           std::find(ring.begin(), ring.end(), last) == ring.end();
  };
  std::array<std::vector<Index>, longest + 1> by_length;
  for (std::size_t first = 0; first < vertices.size(); first += run_length) {
    for (std::size_t i = first; i < std::min(first + run_length, vertices.size()); ++i) {
      const Index v = vertices[i];
      (fits(v) ? by_length[rings[v].size()] : others).push_back(v);
    }
    for (std::size_t length = 0; length <= longest; ++length) {
      std::vector<Index>& list = by_length[length];
      for (std::size_t g = 0; g < list.size(); g += rings_per_group) {
        const std::size_t count = std::min<std::size_t>(rings_per_group, list.size() - g);
        group.push_back({static_cast<Index>(length), static_cast<Index>(count)});
        for (std::size_t lane = 0; lane < rings_per_group; ++lane) {
          vertex.push_back(list[lane < count ? g + lane : g]);
        }
      }
      list.clear();
    }
  }
}

}  // namespace ibmfair
