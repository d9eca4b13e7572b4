// A part of a large mesh that is like the whole, for what the whole would take long to tell.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/local_mesh.h"

namespace ibmfair {

struct MeshSample {
  LocalMesh mesh;
  std::vector<std::uint8_t> inner;  ///< #V, 1 for what moves, and so far from the rims that a flow
                                    ///< up to some 32 edges does there as on the whole mesh
};

/// A few patches of neighbours spread over the vertices that are not held, together about `count`
/// of them (at least 1), or all where there are fewer. Two rings of vertices are held along the
/// rims, as along open boundaries, besides those that are held anyway. Deterministic; which patches
/// depends on how the mesh numbers its vertices.
MeshSample sample_of_mesh(const Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& held, const FlowOptions& options,
                          Index count);

}  // namespace ibmfair
