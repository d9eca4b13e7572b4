// Loops over vertices and their rings, several at a time.
#pragma once

#include <array>

#include "ibmfair/base/row4.h"
#include "ibmfair/flow/ring_groups.h"

namespace ibmfair {

/// As many results as the vertices of a part need, with those that fill up groups.
template <class Result>
using ForPart = std::array<Result, rings_per_group * groups_per_part>;

/// What the triangles and the neighbours around a vertex come to.
struct Surroundings {
  Row4 normal;    ///< sum of the triangles' double area vectors, and its share of the sum of their
                  ///< lengths, or 0
  Row4 half_way;  ///< from the vertex toward the mean of its neighbours
  Row4 along;     ///< what of that is across the normal, or 0 where that is 0
};

/// At the state X (#V x 3), as listed in the groups.
void find_surroundings(const RingRange& range, const Points& X, ForPart<Surroundings>& results);

/// The move of a vertex beside those of its neighbours.
struct Unshared {
  Row4 own;     ///< the move less the mean of theirs, and its square over that of the edges' length
  Row4 strain;  ///< x: the sum of the squared differences, over that of the edges' lengths
};

/// `moves`: for every vertex its move and the squared length of the edges there, negative where it
/// is held. The difference to a vertex that moves counts half: the other has the other half.
void find_unshared(const RingRange& range, const Row4* moves, ForPart<Unshared>& results);

}  // namespace ibmfair
