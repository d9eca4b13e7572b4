// Closed surfaces with cracks: places where the triangles fit, but do not share their edges.
#pragma once

#include <vector>

#include "support/meshes.h"

namespace ibmfair::test {

/// The surface of a closed mesh of triangles, with each triangle cut evenly into n x n triangles, n
/// at random (fixed by `seed`) out of `parts`. Triangles cut in the same way share the vertices on
/// their common edge. Other neighbours share vertices where these have the same place on the edge;
/// all other vertices there are T-junctions: several on one edge, on both sides, in chains.
Mesh unevenly_cut(const Mesh& mesh, const std::vector<Index>& parts, unsigned seed);

/// Quadrilaterals of a cube, cut into n x n squares, with T-junctions like those of unevenly_cut().
Mesh unevenly_cut_cube(const std::vector<Index>& parts, unsigned seed);

/// The mesh with a vertex for each corner of each face, so that faces share no vertices.
Mesh apart(const Mesh& mesh);

/// The mesh with the faces on one side of a plane through its middle separated from the rest: the
/// vertices between both exist twice, at exactly the same place or `distance` apart.
Mesh cut_in_two(const Mesh& mesh, double distance = 0);

/// A closed mesh of triangles, cut open along two edges that meet at the vertex. The vertex exists
/// twice, and the two are `width` apart.
Mesh with_slit(const Mesh& mesh, Index vertex, double width);

}  // namespace ibmfair::test
