// Connectivity of a triangle mesh: edges, hinges, stars, boundary loops, components, and the places
// at which the mesh is not a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// #E x 2 vertex numbers, the smaller one first.
using Edges = Eigen::Matrix<Index, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// #H x 4: an interior edge x0 x1 with the opposite vertices x2 of triangle (x0,x1,x2) and x3 of
/// triangle (x1,x0,x3). [W07] section 3.1.
using Hinges = Eigen::Matrix<Index, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// #H x 2: the triangles (x0,x1,x2) and (x1,x0,x3) of each hinge. In Topology::F, the first
/// triangle always has its corners in that cyclic order. The second triangle does so, too, unless
/// the edge lies on a cut at which no orientation agrees.
using HingeTriangles = Eigen::Matrix<Index, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A cycle or an open chain of boundary edges, as the sequence of its vertices.
struct BoundaryLoop {
  std::vector<Index> vertices;
  bool closed = true;  ///< false if a non-manifold edge interrupts the loop
  bool simple = true;  ///< no vertex occurs twice
};

/// The kind of a vertex. An isolated vertex belongs to no triangle. An irregular vertex is a
/// bow-tie (its triangles form more than one fan) or belongs to a non-manifold edge.
enum class VertexKind : std::uint8_t { isolated, interior, boundary, irregular };

/// Elements at which the mesh is not a surface with area. Their stencils carry no energy, and their
/// vertices are fixed. Numbers are those of the input.
struct Defects {
  std::vector<Index> repeated_corner;  ///< triangles that name a vertex twice
  std::vector<Index> zero_area;        ///< triangles without area to working precision
  std::vector<Index> duplicate;  ///< triangles with the same three vertices as another triangle
  std::vector<Index>
      non_manifold_edges;               ///< edges (rows of Topology::E) of three or more triangles
  std::vector<Index> bow_tie_vertices;  ///< vertices whose triangles form several fans

  bool empty() const;
  /// The number of elements in all five lists.
  std::int64_t count() const;
};

/// Connectivity of a triangle mesh. It does not change after it is built, and depends on positions
/// only through the list of zero-area triangles that is given to build_topology().
struct Topology {
  Index vertex_count = 0;

  /// #F x 3, the input's triangles in the same order. Triangles are reversed so that neighbours
  /// agree; each patch of triangles connected across edges keeps the orientation of its majority.
  Triangles F;
  std::vector<std::uint8_t> usable;  ///< #F, whether the triangle may carry a stencil

  Edges E;                        ///< #E x 2, sorted
  CompressedRows edge_triangles;  ///< #E, the triangles at each edge
  Hinges H;  ///< #H x 4, one for every interior edge between two usable triangles
  HingeTriangles hinge_triangles;  ///< #H x 2
  CompressedRows stars;            ///< #V, the triangles at each vertex (repeated corners left out)

  std::vector<VertexKind> kind;         ///< #V
  std::vector<std::uint8_t> defective;  ///< #V, belongs to an element of `defects`
  std::vector<std::uint8_t> twisted;    ///< #V, lies on a cut where no orientation agrees
  /// #V, the component of each vertex; components are joined at shared vertices. -1 for an isolated
  /// vertex.
  std::vector<Index> component;
  Index component_count = 0;   ///< components with at least one triangle
  Index turned_triangles = 0;  ///< triangles whose orientation in F differs from the input
  bool orientable = true;

  std::vector<BoundaryLoop> boundary_loops;  ///< ordered by their smallest vertex
  Defects defects;

  /// The Euler characteristic, #V(used) - #E + #F(without repeated corners): the sum of 2 - 2 *
  /// genus - #loops over the components.
  std::int64_t euler_characteristic() const;
};

/// Builds the connectivity of `F` (#F x 3, entries in 0 .. vertex_count - 1, in any orientation).
/// The triangles in `zero_area` remain part of the connectivity but carry no stencil. Takes time
/// linear in the size of the mesh. Throws BadMesh for more vertices or triangles than
/// `most_elements` (mesh/mesh.h).
Topology build_topology(Index vertex_count, Triangles F, std::vector<Index> zero_area = {});

/// Builds the topology; `degenerate_triangles` (mesh/geometry.h) finds the zero-area triangles.
Topology build_topology(const Points& X, Triangles F);

/// The neighbours of each vertex: the vertices that an edge connects to it. If is_ringed(v), they
/// are in cyclic order, so that each triangle around v runs from one neighbour to the next;
/// otherwise they are in increasing order.
CompressedRows vertex_rings(const Topology& topology);

/// Whether v is an interior vertex at which all triangles agree in orientation.
inline bool is_oriented_interior(const Topology& topology, Index v) {
  return topology.kind[v] == VertexKind::interior && !topology.twisted[v];
}

/// Whether is_oriented_interior(v), and v has few enough triangles for its ring to be ordered by
/// linear searches.
bool is_ringed(const Topology& topology, Index v);

/// Grows a set of vertices by one ring: the result is true for every vertex of the set and for
/// every vertex that shares a triangle with one.
std::vector<std::uint8_t> grow_one_ring(const Topology& topology,
                                        const std::vector<std::uint8_t>& vertices);

}  // namespace ibmfair
