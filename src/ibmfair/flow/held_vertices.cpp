#include "ibmfair/flow/held_vertices.h"

namespace ibmfair {

std::vector<std::uint8_t> held_vertices(const Topology& topology, BoundaryCondition condition) {
  std::vector<std::uint8_t> held(static_cast<std::size_t>(topology.vertex_count), 0);
  if (condition != BoundaryCondition::free) {
    for (Index v = 0; v < topology.vertex_count; ++v) {
      held[v] = topology.kind[v] == VertexKind::boundary;
    }
  }
  if (condition == BoundaryCondition::fixed) {
    held = grow_one_ring(topology, held);
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (topology.defective[v] || topology.kind[v] == VertexKind::isolated ||
        topology.kind[v] == VertexKind::irregular) {
      held[v] = 1;
    }
  }
  return held;
}

}  // namespace ibmfair
