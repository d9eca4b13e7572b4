// The part of a mesh that one rank has: the vertices that belong to it, and around them what the
// stencils at these reach.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "petsc_engine/blocks.h"

namespace ibmfair::petsc {

/// A mesh as it comes out of a file, dealt out in blocks.
struct BlockMesh {
  Blocks vertices, triangles;
  std::vector<std::array<double, 3>> X;  ///< of this rank's vertices
  std::vector<std::array<Index, 3>> F;   ///< this rank's triangles, by the vertices' numbers
};

struct MeshPiece {
  Blocks vertices, triangles;  ///< of the file

  /// The numbers that the vertices have in the file: first those of this rank, then those of
  /// others, each in increasing order. All other members count vertices by their place in here.
  std::vector<Index> vertex;
  Index own = 0;  ///< how many of them are this rank's

  /// Where the others belong: a rank, and the vertex's place there.
  struct Home {
    int rank;
    Index place;
  };
  std::vector<Home> home;  ///< of vertices own, own + 1, ...

  Points X;  ///< #V x 3
  /// All triangles at this rank's vertices and at the neighbours of these, as the file orders them
  /// and their corners.
  Triangles F;
  std::vector<Index> triangle;  ///< #F, the numbers that they have in the file
  /// #F, whether the triangle belongs to this rank, which has its first corner.
  std::vector<std::uint8_t> own_triangle;
};

/// Distributes the mesh. `rank_of` says for each vertex of this rank's block where it goes.
/// Collective.
MeshPiece make_piece(const Communicator& comm, const BlockMesh& mesh,
                     const std::vector<int>& rank_of);

}  // namespace ibmfair::petsc
