// A patch and its surroundings, cut out of the mesh, so that everything done to it costs what the
// patch costs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/edge_set.h"
#include "ibmfair/fill/triangle_net.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// An edge between the patch and the mesh: the patch's triangle runs from a to b.
struct RimEdge {
  Index a, b;           ///< local vertices
  Index mesh_triangle;  ///< in Topology::F
};

/// Vertices are numbered locally: the surroundings' first, then the patch's own.
struct Patch {
  Points X;
  std::vector<Index> mesh_vertex;  ///< of each vertex of the surroundings
  Triangles surroundings;          ///< every triangle that shares a stencil with a free vertex
  TriangleNet net;                 ///< the patch; holes that touch make one patch of several discs
  std::vector<RimEdge> rim;
  EdgeSet taken;  ///< edges that the patch must not have: the mesh, or two discs, would share them
  bool one_disc = true;
  std::vector<double> spacing;     ///< per vertex: the edge length of the mesh around
  std::vector<double> wanted;      ///< per vertex: the edge length to refine to at present
  std::vector<std::uint8_t> free;  ///< per vertex: may be moved
  Index own_from = 0;              ///< the first of the patch's own vertices

  Index size() const { return static_cast<Index>(X.rows()); }
  Index own_size() const { return size() - own_from; }
};

/// The vertices of the triangles at `vertices`, themselves included, sorted.
std::vector<Index> grown_by_ring(const Topology& topology, const std::vector<Index>& vertices);

/// Triangulates the polygons `loops` (mesh vertices, none twice in a loop, the mesh to their left)
/// and cuts out what the fairing of the patch needs to know of the mesh. `free_rings` rings of
/// vertices outside may move, the loops themselves being the first. Throws BadMesh, with the
/// reason, where a loop cannot be triangulated.
Patch cut_patch(const Points& X, const Topology& topology,
                const std::vector<std::vector<Index>>& loops, int free_rings = 0);

/// The patch that consists of the triangles of the mesh at the vertices of `region`, which may
/// move; it has no vertices of its own, and all others are fixed.
Patch cut_region(const Points& X, const Topology& topology, const std::vector<Index>& region);

}  // namespace ibmfair
