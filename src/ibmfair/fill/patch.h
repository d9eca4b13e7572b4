// A patch and its surroundings, cut out of the mesh, so that the cost of all work on the patch
// depends on the size of the patch, not of the mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/fill/edge_set.h"
#include "ibmfair/fill/triangle_net.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// An edge between the patch and the mesh. The triangle of the patch runs along it from a to b.
struct RimEdge {
  Index a, b;           ///< local vertices
  Index mesh_triangle;  ///< the triangle on the side of the mesh, a row of Topology::F
};

/// Vertices are numbered locally: first those of the surroundings, then the patch's own.
struct Patch {
  Points X;                        ///< positions, #vertices x 3
  std::vector<Index> mesh_vertex;  ///< the mesh vertex of each vertex of the surroundings
  /// Every triangle that shares a stencil with a free vertex, except `protruding`.
  Triangles surroundings;
  /// Rows of Topology::F: triangles that hang on the mesh by one edge at the rim and stand up from
  /// it steeply. The patch ends at them, but takes no direction from them.
  std::vector<Index> protruding;
  TriangleNet net;  ///< the patch; holes that touch make one patch of several discs
  std::vector<RimEdge> rim;
  EdgeSet taken;         ///< edges that the patch must not use: the mesh or another disc has them
  bool one_disc = true;  ///< the patch fills a single loop
  EdgeSet creases;       ///< edges of the patch at which sheets meet (fill/split_hole.h)
  std::vector<double> spacing;  ///< per vertex: edge length of the surrounding mesh
  /// Edge length, instead of that of the surrounding mesh, for vertices that refinement adds; 0 for
  /// that of the surrounding mesh.
  double inner_spacing = 0;
  std::vector<double> wanted;      ///< per vertex: edge length to refine to at present
  std::vector<std::uint8_t> free;  ///< per vertex: whether it may move
  Index own_from = 0;              ///< number of the first of the patch's own vertices

  Index size() const { return static_cast<Index>(X.rows()); }
  Index own_size() const { return size() - own_from; }
};

/// The triangles of the surroundings, followed by those of the patch, #F x 3.
Triangles all_triangles(const Patch& patch);

/// The number of edges of the rim. With `inner_spacing`, the number of edges of that length that
/// fit along the rim.
double edges_along_rim(const Patch& patch);

/// The vertices of all triangles at `vertices`, including `vertices`, sorted.
std::vector<Index> grown_by_ring(const Topology& topology, const std::vector<Index>& vertices);

/// The vertices of the mesh within so many rings of the patch's rim, sorted.
std::vector<Index> vertices_around_rim(const Topology& topology, const Patch& patch, int rings);

/// The mean length of the rim's edges.
double mean_rim_edge_length(const Patch& patch);

/// What a disc or a ring of a patch fills: a loop (mesh vertices, none twice, the mesh to its
/// left), without the island inside it if there is one.
struct PatchOutline {
  std::vector<Index> loop;
  std::vector<Index> island = {};  ///< a loop of another component
  bool tube = false;               ///< a bridge: `island` is the loop at the other end of a tube
};

/// Triangulates the outlines and cuts the part of the mesh out that the fairing of the patch needs.
/// The rim of the patch lists the edges of each loop, followed by those of its island. `free_rings`
/// rings of mesh vertices may move; the loops themselves are the first ring. Throws BadMesh, with
/// the reason, if an outline cannot be triangulated.
Patch cut_patch(const Points& X, const Topology& topology,
                const std::vector<PatchOutline>& outlines, int free_rings = 0);

/// The patch that consists of the mesh triangles at the vertices of `region`. These vertices may
/// move, except at defects; all others are fixed. The patch has no vertices of its own.
Patch cut_region(const Points& X, const Topology& topology, const std::vector<Index>& region);

}  // namespace ibmfair
