// Fills groups of holes that have to be filled together: triangulates, refines, fairs and audits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/fill/fill_holes.h"

namespace ibmfair {

HoleReport report_of(Index hole, HoleStatus status, std::string reason = {});

/// Holes that are filled together, and the result.
struct FilledGroup {
  std::vector<Index> holes;         ///< the holes (Hole::id) that `patch` fills
  std::optional<Patch> patch;       ///< none if the holes could not be filled
  std::vector<Index> hole_of_rim;   ///< the hole of each rim edge of the patch
  Index most_vertices = 0;          ///< the most vertices that the patch may have of its own
  std::vector<HoleReport> reports;  ///< one per hole of the group
};

class HoleFiller {
 public:
  /// All arguments must outlive this object. `holes`: the result of find_holes.
  HoleFiller(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
             const FillOptions& options)
      : X_(X), topology_(topology), holes_(holes), options_(options) {}

  /// Triangulates the holes of a group (by Hole::id) together; if one of them cannot be
  /// triangulated, each hole separately.
  std::vector<FilledGroup> cut(const std::vector<Index>& group, Index most_vertices) const;

  /// Refines, fairs and audits the patch that `cut` has triangulated, and writes the reports.
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
