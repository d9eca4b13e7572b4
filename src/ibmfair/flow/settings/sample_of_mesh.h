// A representative part of a large mesh, for estimates that would take long on the whole mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/passes/local_mesh.h"

namespace ibmfair {

struct MeshSample {
  LocalMesh mesh;
  std::vector<std::uint8_t> inner;  ///< #V, 1 for vertices that are not fixed and so far from the
                                    ///< rims that a flow with a cut-off up to some 32 edges has the
                                    ///< same effect there as on the whole mesh
};

/// A few connected patches, spread over the vertices that are not fixed, with about `count` (at
/// least 1) vertices in total, or all vertices if there are fewer. In addition to the vertices
/// fixed by `fixed`, two rings of vertices are fixed along the rims of the patches, as along open
/// boundaries. Deterministic; the choice of the patches depends on the vertex numbering.
MeshSample sample_of_mesh(const Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                          Index count);

}  // namespace ibmfair
