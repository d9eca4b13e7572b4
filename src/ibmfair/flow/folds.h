// Hinges that are folded over, and a watch that no new one appears.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A hinge with a smaller dihedral angle than this (radians; 10 degrees) counts as folded over.
inline constexpr double fold_angle = 0.17453292519943295;

/// Whether each hinge has a smaller dihedral angle than this (radians, at most pi / 2), #H; one
/// with a triangle that has no area has.
std::vector<std::uint8_t> folded_hinges(const Points& X, const Topology& topology,
                                        double angle = fold_angle);

/// All hinges with a smaller dihedral angle than `angle` turn by more than this, as the energy sees
/// it: 1 + cos(theta) (BendingEnergy::largest_turn).
double least_turn(double angle = fold_angle);

/// Watches the hinges that a set of unknown vertices can move.
class FoldWatch {
 public:
  /// Refers to the topology and the unknowns. Hinges folded at `X` are known from then on and never
  /// reported.
  FoldWatch(const Points& X, const Topology& topology, const Unknowns& unknowns);

  /// The vertices (sorted, each once) of hinges folded at `X` that were not folded at the start.
  /// Only hinges are looked at whose vertices are `near` (#V flags, or empty for all).
  std::vector<Index> new_folds(const Points& X, const std::vector<std::uint8_t>& near = {});

 private:
  void list_hinges();
  void find_normals(const Points& X, const std::vector<std::uint8_t>& near);
  bool is_folded_now(std::size_t i) const;

  const Topology& topology_;
  const Unknowns& unknowns_;
  std::vector<std::uint8_t> known_;  // #H

  // Made by the first look: where the energy rules folds out, there is none.
  std::vector<Index> hinges_;         // with an unknown, not known
  std::vector<std::uint8_t> turned_;  // of each, whether its triangles' orientations disagree
  std::vector<std::uint8_t> folded_;  // at the last look
  std::vector<Index> triangles_;      // of the hinges
  std::vector<Vec3> normals_;         // #F, their double area vectors at the last look
};

}  // namespace ibmfair
