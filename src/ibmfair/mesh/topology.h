// What the triangles say about neighbourhood: edges, hinges, stars, boundary loops, components,
// and the places where the mesh is not a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// #E x 2 vertex numbers, the smaller one first.
using Edges = Eigen::Matrix<Index, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// #H x 4: an interior edge x0 x1 with the opposite vertices x2 of triangle (x0,x1,x2) and x3 of
/// triangle (x1,x0,x3). [W07] section 3.1.
using Hinges = Eigen::Matrix<Index, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// #H x 2: the triangles (x0,x1,x2) and (x1,x0,x3) of each hinge. The first always runs through its
/// corners in that order in Topology::F; the second does too unless the edge lies on a cut where no
/// orientation agrees.
using HingeTriangles = Eigen::Matrix<Index, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A cycle of boundary edges, as the vertices met along it.
struct BoundaryLoop {
  std::vector<Index> vertices;
  bool closed = true;  ///< false where a non-manifold edge interrupts the walk
  bool simple = true;  ///< no vertex is met twice
};

/// Where a vertex lies. An isolated vertex belongs to no triangle; an irregular one is a bow-tie
/// (its triangles form more than one fan) or touches a non-manifold edge.
enum class VertexKind : std::uint8_t { isolated, interior, boundary, irregular };

/// Elements around which the mesh is not a surface with area. Their stencils carry no energy and
/// their vertices are held fixed; numbers are those of the input.
struct Defects {
  std::vector<Index> repeated_corner;  ///< triangles that name a vertex twice
  std::vector<Index> zero_area;        ///< triangles without area to working precision
  std::vector<Index> duplicate;        ///< triangles over the same three vertices as another
  std::vector<Index>
      non_manifold_edges;               ///< edges (rows of Topology::E) of three or more triangles
  std::vector<Index> bow_tie_vertices;  ///< vertices whose triangles form several fans

  bool empty() const;
  /// The number of elements in all five lists.
  std::int64_t count() const;
};

/// Connectivity of a triangle mesh; fixed once built, independent of positions except for the list
/// of zero-area triangles that the builder is given.
struct Topology {
  Index vertex_count = 0;

  Triangles F;  ///< #F x 3, the input's triangles in their order, each turned so that neighbours
                ///< agree; a component keeps the orientation of the majority of its triangles
  std::vector<std::uint8_t> usable;  ///< #F, whether the triangle may carry a stencil

  Edges E;              ///< #E x 2, sorted
  Rows edge_triangles;  ///< #E, the triangles at each edge
  Hinges H;             ///< #H x 4, one for every interior edge between two usable triangles
  HingeTriangles hinge_triangles;  ///< #H x 2
  Rows stars;                      ///< #V, the triangles at each vertex (repeated corners left out)

  std::vector<VertexKind> kind;         ///< #V
  std::vector<std::uint8_t> defective;  ///< #V, touches an element of `defects`
  std::vector<std::uint8_t> twisted;    ///< #V, lies on a cut where no orientation agrees
  std::vector<Index> component;         ///< #V, components joined by shared vertices; isolated: -1
  Index component_count = 0;            ///< components that have a triangle
  Index turned_triangles = 0;           ///< triangles whose orientation in F is not the input's
  bool orientable = true;

  std::vector<BoundaryLoop> boundary_loops;  ///< ordered by their smallest vertex
  Defects defects;

  /// 2 - 2 * genus - #loops summed over components: #V(used) - #E + #F(without repeated corners).
  std::int64_t euler_characteristic() const;
};

/// Builds the connectivity of `F` (#F x 3, entries in 0 .. vertex_count - 1, in any orientation).
/// Triangles listed in `zero_area` keep their place in the neighbourhood but carry no stencil.
/// Linear in the size of the mesh. Throws BadMesh for more vertices or triangles than
/// `most_elements` (mesh/mesh.h).
Topology build_topology(Index vertex_count, Triangles F, std::vector<Index> zero_area = {});

/// Builds the topology with the zero-area triangles that `degenerate_triangles` finds
/// (mesh/geometry.h).
Topology build_topology(const Points& X, Triangles F);

/// The vertices that each vertex has an edge to: where is_ringed, in the order in which its
/// triangles follow one another, each running from one of them to the next and the last one to the
/// first; elsewhere in increasing order.
Rows vertex_rings(const Topology& topology);

/// Whether v is an interior vertex around which all triangles are oriented alike.
inline bool is_oriented_interior(const Topology& topology, Index v) {
  return topology.kind[v] == VertexKind::interior && !topology.twisted[v];
}

/// Whether v is such a vertex, and has few enough triangles to be put in order one by one.
bool is_ringed(const Topology& topology, Index v);

/// Grows a vertex set by one ring: true for every vertex that shares a triangle with a true one.
std::vector<std::uint8_t> grow_one_ring(const Topology& topology,
                                        const std::vector<std::uint8_t>& vertices);

}  // namespace ibmfair
