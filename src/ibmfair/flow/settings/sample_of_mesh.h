// A representative part of a large mesh, for estimates that would take long on the whole mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/passes/local_mesh.h"

namespace ibmfair {

/// Meshes with many more moving vertices than `vertices` are sampled.
struct SampleSize {
  Index vertices = 0;
  int felt_rings =
      0;  ///< that the rim of a sample affects; about twice the cut-off in edges is safe
};

struct MeshSample {
  LocalMesh mesh;
  /// #V, 1 for vertices that are neither fixed nor among the felt rings: a flow has the same effect
  /// there as on the whole mesh.
  std::vector<std::uint8_t> inner;
};

/// A few connected patches, spread over the vertices that are not fixed, with about as many
/// vertices (at least 1) in total, or all vertices if there are fewer. In addition to the vertices
/// fixed by `fixed`, two rings of vertices are fixed along the rims of the patches, as along open
/// boundaries. Deterministic; the choice of the patches depends on the vertex numbering.
MeshSample sample_of_mesh(const Points& X, const Topology& topology,
                          const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                          const SampleSize& size);

}  // namespace ibmfair
