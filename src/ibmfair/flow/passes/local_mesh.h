// A copy of a mesh, or of a part of it, with a vertex numbering of its own.
//
// Meshes come with their vertices in any order. If neighbouring vertices are far apart in memory, a
// flow takes several times as long, mostly waiting for memory; so the flow renumbers such a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Whether a flow should renumber the mesh: most edges join vertices that are far apart in memory,
/// and the mesh does not fit into the cache. False if the mesh is not orientable, because the
/// position of the cut along which the orientations disagree depends on the numbering.
bool is_scattered(const Topology& topology);

/// The input of a flow for a renumbered mesh or a part of a mesh.
struct LocalMesh {
  std::vector<Index> vertex;  ///< #V, the number of each vertex in the original mesh
  Points X;
  Topology topology;
  std::vector<std::uint8_t> fixed;
  FlowOptions options;
};

/// All of the mesh, numbered block by block (energy/vertex_blocks.h).
LocalMesh local_mesh(const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& fixed, const FlowOptions& options);

/// A part of the mesh: the listed triangles and vertices, in the order of the lists. `place` (#V):
/// the position of each listed vertex in `vertices`. All vertices of the result are fixed, and its
/// options are defaults.
LocalMesh some_of_mesh(const Points& X, const Topology& topology, std::vector<Index> vertices,
                       const std::vector<Index>& triangles, const std::vector<Index>& place);

/// Copies the entries for these vertices and triangles from the lists in `options`, the options of
/// the whole mesh, to `local`.
void take_lists(const FlowOptions& options, const std::vector<Index>& vertices,
                const std::vector<Index>& triangles, FlowOptions& local);

}  // namespace ibmfair
