// Fills holes that belong together: triangulates, refines, fairs and judges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/fill/fill_holes.h"

namespace ibmfair {

HoleReport report_of(Index hole, HoleStatus status, std::string reason = {});

/// Holes that are filled together, and what becomes of them.
struct FilledGroup {
  std::vector<Index> holes;  ///< those that `patch` fills
  std::optional<Patch> patch;
  std::vector<Index> hole_of_rim;   ///< per rim edge of the patch
  Index most_vertices = 0;          ///< that the patch may have
  std::vector<HoleReport> reports;  ///< one per hole of the group
};

class HoleFiller {
 public:
  /// Refers to all of them. `holes` are those of find_holes.
  HoleFiller(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
             const FillOptions& options)
      : X_(X), topology_(topology), holes_(holes), options_(options) {}

  /// Triangulates the holes of a group (by Hole::id) together, or each alone where one of them
  /// cannot be.
  std::vector<FilledGroup> cut(const std::vector<Index>& group, Index most_vertices) const;

  /// Refines, fairs and judges what was triangulated.
  void finish(FilledGroup& group) const;

 private:
  FilledGroup cut_together(const std::vector<Index>& group, Index most_vertices) const;
  HoleReport refined_and_faired(Patch& patch, Index most_vertices) const;
  HoleReport faired(Patch& patch) const;
  HoleReport refined_while_faired(Patch& patch, Index most_vertices) const;

  const Points& X_;
  const Topology& topology_;
  const std::vector<Hole>& holes_;
  const FillOptions& options_;
};

}  // namespace ibmfair
