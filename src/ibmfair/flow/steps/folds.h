// Foldovers: hinges (edges with their two triangles) that are folded over, a watch for new
// foldovers, and moves that make none.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A hinge with a smaller dihedral angle than this (radians; 10 degrees) counts as folded over.
inline constexpr double fold_angle = 0.17453292519943295;

/// Whether each hinge has a smaller dihedral angle than `angle` (radians, at most pi / 2), #H
/// flags. A hinge with a triangle without area counts as folded over.
std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology,
                                        double angle = fold_angle);

/// A lower bound of 1 + cos(theta) (BendingEnergy::max_dihedral_turn) for all hinges whose dihedral
/// angle theta is smaller than `angle`.
double least_turn(double angle = fold_angle);

/// Watches for hinges that fold over.
class FoldWatch {
 public:
  /// The topology must outlive this object. Hinges that are folded over at `X` (#V x 3) are never
  /// reported.
  FoldWatch(const Points& X, const Topology& topology);

  /// The vertices (sorted, each once) of hinges that are folded over at `X` and were not at the
  /// start. Only hinges with vertices flagged in `near` (#V, or empty for all) are checked.
  std::vector<Index> new_folds(const Points& X, const std::vector<std::uint8_t>& near = {}) const;

 private:
  const Topology& topology_;
  std::vector<std::uint8_t> known_;  // #H, folded over at the start
};

/// Moves X by `moves` (both #V x 3). Where a hinge would fold over that was not folded before,
/// moves are halved (GuardTuning::most_halvings), and in the end not made. Returns the vertices
/// whose moves were not made in full, some of them more than once.
std::vector<Index> move_without_folds(Points moves, const Topology& topology, Points& X);

}  // namespace ibmfair
