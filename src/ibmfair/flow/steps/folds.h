// Foldovers: hinges (edges with their two triangles) that are folded over, and a watch for new
// foldovers.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/unknowns.h"
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

/// Watches the hinges that a set of unknown vertices can move.
class FoldWatch {
 public:
  /// The topology and the unknowns must outlive this object. Hinges that are folded over at `X` are
  /// never reported.
  FoldWatch(const Points& X, const Topology& topology, const Unknowns& unknowns);

  /// The vertices (sorted, each once) of hinges that are folded over at `X` and were not at the
  /// start. Only hinges with vertices flagged in `near` (#V, or empty for all) are checked.
  std::vector<Index> new_folds(const Points& X, const std::vector<std::uint8_t>& near = {});

 private:
  void list_hinges();
  void find_normals(const Points& X, const std::vector<std::uint8_t>& near);
  bool is_folded_now(std::size_t i) const;

  const Topology& topology_;
  const Unknowns& unknowns_;
  std::vector<std::uint8_t> known_;  // #H

  // Built by the first check, as the energy often rules foldovers out so that no check is needed.
  std::vector<Index> hinges_;         // hinges with an unknown that were not folded at the start
  std::vector<std::uint8_t> turned_;  // for each, whether its triangles' orientations disagree
  std::vector<std::uint8_t> folded_;  // for each, whether it was folded over at the last check
  std::vector<Index> triangles_;      // the triangles of these hinges
  std::vector<Vec3> normals_;         // #F, their double area vectors at the last check
};

}  // namespace ibmfair
