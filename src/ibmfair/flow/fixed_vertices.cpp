#include "ibmfair/flow/fixed_vertices.h"

namespace ibmfair {

std::vector<std::uint8_t> fixed_vertices(const Topology& topology, BoundaryCondition condition) {
  std::vector<std::uint8_t> fixed(static_cast<std::size_t>(topology.vertex_count), 0);
  if (condition != BoundaryCondition::free) {
    for (Index v = 0; v < topology.vertex_count; ++v) {
      fixed[v] = topology.kind[v] == VertexKind::boundary;
    }
  }
  if (condition == BoundaryCondition::fixed) {
    fixed = grow_one_ring(topology, fixed);
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (topology.defective[v] || topology.kind[v] == VertexKind::isolated ||
        topology.kind[v] == VertexKind::irregular) {
      fixed[v] = 1;
    }
  }
  return fixed;
}

}  // namespace ibmfair
