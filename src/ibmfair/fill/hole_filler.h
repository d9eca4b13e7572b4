// Fills groups of holes that have to be filled together: triangulates, refines, fairs and audits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ibmfair/fill/continued_creases.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/fill/patch_methods.h"

namespace ibmfair {

HoleReport report_of(Index hole, HoleStatus status, std::string reason = {});

/// Holes that are filled together, and the result.
struct FilledGroup {
  std::vector<Index> holes;        ///< the holes (Hole::id) that the patch fills
  std::optional<Patch> plain;      ///< the triangulated holes; none if that failed
  std::optional<Patch> patch;      ///< none if the holes could not be filled
  std::vector<Index> hole_of_rim;  ///< the hole of each rim edge of the patch
  Index most_vertices = 0;         ///< the most vertices that the patch may have of its own
  std::optional<RimSurroundings> surroundings;  ///< if they decide on the methods
  std::optional<ContinuedCreases> creases;      ///< those that end at the rim, if they are to go on
  std::vector<PatchMethod> methods;             ///< in the order in which they are tried
  std::size_t method = 0;                       ///< number of the method that made `patch`
  std::vector<RejectedPatch> rejected;          ///< by earlier methods
  std::vector<HoleReport> reports;              ///< one per hole of the group
};

class HoleFiller {
 public:
  /// All arguments must outlive this object. `holes`: the result of find_holes. `surrounding`: the
  /// result of surrounding_holes, for holes that are to be filled as rings; of a bridge, one end
  /// counts as surrounded by the other. `bridges`: BridgePlan::other_end.
  HoleFiller(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
             const std::vector<Index>& surrounding, const std::vector<Index>& bridges,
             const FillOptions& options);

  /// Triangulates the holes of a group (by Hole::id) together; if one of them cannot be
  /// triangulated, each hole or bridge separately.
  std::vector<FilledGroup> cut(const std::vector<Index>& group, Index most_vertices) const;

  /// Refines, fairs and audits the patch that `cut` has triangulated, by the first method whose
  /// patch can be used, and writes the reports. Whether the patch intersects the mesh is not
  /// looked at.
  void finish(FilledGroup& group) const;

  /// Whether another method can be tried for the group.
  bool has_further_method(const FilledGroup& group) const {
    return group.patch && group.method + 1 < group.methods.size();
  }

  /// Rejects the patch of the group for `reason` and continues with the next method.
  void finish_otherwise(FilledGroup& group, const std::string& reason) const;

 private:
  struct Attempt;

  std::vector<Index> together_with(Index hole) const;
  FilledGroup cut_together(const std::vector<Index>& group, Index most_vertices) const;
  void choose_methods(FilledGroup& group) const;
  void continue_creases(FilledGroup& group) const;
  std::optional<CreaseReport> crease_report(const FilledGroup& group) const;
  Attempt attempt(const FilledGroup& group, const PatchMethod& method,
                  const PatchLimits& limits) const;
  void make(Attempt& attempt, const FilledGroup& group, const PatchMethod& method,
            const PatchLimits& limits) const;
  void make_creased(Attempt& attempt, const FilledGroup& group, const PatchMethod& method,
                    const PatchLimits& limits) const;
  std::vector<RingShift> shifts_of(const FilledGroup& group) const;
  void make_on_one_level(Attempt& attempt, const PatchMethod& method,
                         const PatchLimits& limits) const;
  void accept(FilledGroup& group, Attempt attempt) const;
  void leave_open(FilledGroup& group) const;

  const Points& X_;
  const Topology& topology_;
  const std::vector<Hole>& holes_;
  const std::vector<Index>& surrounding_;
  const std::vector<Index>& bridges_;
  const FillOptions& options_;
};

}  // namespace ibmfair
