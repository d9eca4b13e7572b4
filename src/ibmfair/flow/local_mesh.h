// A mesh for a flow under numbers of its own.
//
// Meshes come with their vertices in any order. Where neighbours are far apart in memory, a flow
// takes several times as long, most of it waiting for memory; so it numbers such a mesh anew.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Whether a flow had better number the mesh anew: nearly all of its edges are long in memory, and
/// the cache does not hold it. Not where the mesh is not orientable: where the cut lies, along
/// which its orientations disagree, depends on the numbers.
bool is_scattered(const Topology& topology);

/// What a flow takes, of all of a mesh or some of it.
struct LocalMesh {
  std::vector<Index> vertex;  ///< #V, the mesh's own number of each
  Points X;
  Topology topology;
  std::vector<std::uint8_t> held;
  FlowOptions options;
};

/// All of the mesh, numbered block by block (energy/vertex_blocks.h).
LocalMesh local_mesh(const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& held, const FlowOptions& options);

/// Some of its triangles, over some of its vertices, in the order of these lists. `place`: #V,
/// where each of these vertices stands in their list. All are held, and there are no options yet.
LocalMesh some_of_mesh(const Points& X, const Topology& topology, std::vector<Index> vertices,
                       const std::vector<Index>& triangles, const std::vector<Index>& place);

/// Of the lists in the options for the whole mesh, what belongs to these vertices and triangles.
void take_lists(const FlowOptions& options, const std::vector<Index>& vertices,
                const std::vector<Index>& triangles, FlowOptions& local);

}  // namespace ibmfair
