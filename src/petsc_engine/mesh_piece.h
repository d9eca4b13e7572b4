// The part of a mesh that one rank stores: the vertices that belong to the rank, and the triangles
// and further vertices that the stencils at these vertices reach.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// A mesh as read from a file, distributed in blocks.
struct BlockMesh {
  Blocks vertices, triangles;
  std::vector<std::array<double, 3>> X;  ///< positions of the vertices in this rank's block
  std::vector<std::array<Index, 3>> F;   ///< this rank's block of triangles, by vertex numbers
};

struct MeshPiece {
  Blocks vertices, triangles;  ///< how the file's rows are distributed

  /// The file's numbers of the vertices: first the vertices of this rank, then the vertices of
  /// other ranks, both in increasing order. All other members use indices into this list.
  std::vector<Index> vertex;
  Index own = 0;  ///< how many of these vertices belong to this rank

  /// The owner of a vertex of another rank: the rank, and the vertex's index in its piece.
  struct Home {
    int rank;
    Index place;
  };
  std::vector<Home> home;  ///< of the vertices own, own + 1, ...

  Points X;  ///< #V x 3
  /// All triangles at this rank's vertices and at their neighbours. The order of the triangles and
  /// of their corners is that of the file.
  Triangles F;
  std::vector<Index> triangle;  ///< #F, the file's numbers of the triangles
  /// #F, whether the triangle belongs to this rank: a triangle belongs to the rank of its first
  /// corner.
  std::vector<std::uint8_t> own_triangle;
};

/// Distributes the mesh. `rank_of` gives the destination rank of each vertex in this rank's block.
/// Collective.
MeshPiece make_piece(const Communicator& comm, const BlockMesh& mesh,
                     const std::vector<int>& rank_of);

}  // namespace ibmfair::petsc
