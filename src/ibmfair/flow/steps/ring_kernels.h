// Loops over vertices and their rings, several vertices at a time.
#pragma once

#include <array>

#include "ibmfair/base/row4.h"
#include "ibmfair/flow/steps/ring_groups.h"

namespace ibmfair {

/// The results for the vertices of a part, including the vertices that pad groups.
template <class Result>
using ForPart = std::array<Result, rings_per_group * groups_per_part>;

/// Sums over the triangles and the neighbours around a vertex.
struct Surroundings {
  Row4 normal;    ///< xyz: the sum N of the triangles' double area vectors; w: |N| over the sum of
                  ///< their lengths, or 0 if that is 0
  Row4 half_way;  ///< xyz: half of the vector from the vertex to the mean of its neighbours
  Row4 along;     ///< xyz: `half_way` projected off N, or 0 if N is 0
};

/// The surroundings of the vertices of the range at the state X (#V x 3), in the order of the
/// groups.
void find_surroundings(const RingRange& range, const Points& X, ForPart<Surroundings>& results);

/// The move of a vertex compared with the moves of its neighbours.
struct Unshared {
  Row4 own;     ///< xyz: the move minus the mean of the neighbours' moves; w: the square of that
                ///< over the squared edge length
  Row4 strain;  ///< x: the sum over the neighbours of the squared difference of the moves over the
                ///< squared edge length
};

/// `moves`: for every vertex, its move (xyz) and the squared length of the edges there (w), with a
/// negative sign if the vertex is fixed. The difference to a neighbour that moves counts half, as
/// that neighbour counts the other half.
void find_unshared(const RingRange& range, const Row4* moves, ForPart<Unshared>& results);

}  // namespace ibmfair
