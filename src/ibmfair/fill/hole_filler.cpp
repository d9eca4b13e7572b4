#include "ibmfair/fill/hole_filler.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/fill/refine.h"

namespace ibmfair {
namespace {

std::vector<std::uint8_t> rim_of(const FilledGroup& result, Index hole) {
  std::vector<std::uint8_t> chosen(result.hole_of_rim.size());
  std::transform(result.hole_of_rim.begin(), result.hole_of_rim.end(), chosen.begin(),
                 [hole](Index h) { return h == hole ? 1 : 0; });
  return chosen;
}

HoleReport concluded(const FairingReport& fairing, bool converged, bool refined) {
  HoleReport report = report_of(0, HoleStatus::filled);
  report.fairing = fairing;
  if (!refined) {
    report.status = HoleStatus::coarse;
    report.reason = "the limit of new vertices ended its refinement";
  } else if (!converged) {
    report.status = HoleStatus::not_converged;
    report.reason = "the fairing did not reach its tolerance";
  }
  return report;
}

/// Refines and fairs the patch level by level, from coarse to fine.
HoleReport faired_by_levels(Patch& patch, Index most_vertices, const FairingOptions& options) {
  bool refined = true;
  try {
    const FairingReport fairing = refine_and_fair(patch, options, most_vertices, refined);
    return concluded(fairing, fairing.converged, refined);
  } catch (const FactorizationFailed& error) {
    return report_of(0, HoleStatus::not_converged, error.what());
  }
}

}  // namespace

HoleReport report_of(Index hole, HoleStatus status, std::string reason) {
  HoleReport report;
  report.hole = hole;
  report.status = status;
  report.reason = std::move(reason);
  return report;
}

std::vector<FilledGroup> HoleFiller::cut(const std::vector<Index>& group,
                                         Index most_vertices) const {
  std::vector<FilledGroup> results;
  try {
    results.push_back(cut_together(group, most_vertices));
    return results;
  } catch (const BadMesh& error) {
    if (group.size() == 1) {
      results.emplace_back();
      results.back().reports.push_back(report_of(group.front(), HoleStatus::failed, error.what()));
      return results;
    }
  }
  for (const Index hole : group) {
    for (FilledGroup& part : cut({hole}, most_vertices / static_cast<Index>(group.size()))) {
      results.push_back(std::move(part));
    }
  }
  return results;
}

void HoleFiller::finish(FilledGroup& group) const {
  if (!group.patch) {
    return;
  }
  HoleReport report = refined_and_faired(*group.patch, group.most_vertices);
  if (!group.patch->X.allFinite()) {  // geometric predicates need finite coordinates
    group.patch.reset();
    for (const Index hole : group.holes) {
      group.reports.push_back(
          report_of(hole, HoleStatus::failed, "its coordinates are too large to compute with"));
    }
    return;
  }
  const std::vector<Index> nearest = nearest_rim_edges(*group.patch);
  for (const Index hole : group.holes) {
    report.hole = hole;
    report.seam = audit_seam(*group.patch, nearest, rim_of(group, hole));
    group.reports.push_back(report);
  }
}

FilledGroup HoleFiller::cut_together(const std::vector<Index>& group, Index most_vertices) const {
  FilledGroup result;
  result.holes = group;
  result.most_vertices = most_vertices;
  std::vector<std::vector<Index>> loops;
  for (const Index hole : group) {
    if (!holes_[hole].closed) {
      throw BadMesh("its boundary ends at an edge of three or more triangles");
    }
    for (auto& loop : simple_loops(holes_[hole].loop)) {
      result.hole_of_rim.insert(result.hole_of_rim.end(), loop.size(), hole);
      loops.push_back(std::move(loop));
    }
  }
  result.patch = cut_patch(X_, topology_, loops, options_.rim_smooth);
  return result;
}

HoleReport HoleFiller::refined_and_faired(Patch& patch, Index most_vertices) const {
  if (options_.fair) {
    return options_.refine ? refined_while_faired(patch, most_vertices) : faired(patch);
  }
  bool refined = true;
  if (options_.refine) {
    refined = refine(patch, {1, false, most_vertices});
  } else {
    split_taken_edges(patch);
  }
  return concluded({}, true, refined);
}

HoleReport HoleFiller::faired(Patch& patch) const {
  split_taken_edges(patch);
  try {
    const FairingReport fairing = fair(patch, options_.fairing);
    return concluded(fairing, fairing.converged, true);
  } catch (const FactorizationFailed& error) {
    return report_of(0, HoleStatus::not_converged, error.what());
  }
}

/// If fairing from coarse to fine does not converge, as at a rim with a sharp tip that the few
/// triangles of the coarsest level cannot follow, fairing the finest level alone may converge.
HoleReport HoleFiller::refined_while_faired(Patch& patch, Index most_vertices) const {
  Patch second = patch;
  HoleReport report = faired_by_levels(patch, most_vertices, options_.fairing);
  if (report.status != HoleStatus::not_converged || report.fairing.levels == 1) {
    return report;
  }
  FairingOptions options = options_.fairing;
  options.most_levels = 1;
  HoleReport again = faired_by_levels(second, most_vertices, options);
  if (again.status == HoleStatus::not_converged) {
    return report;
  }
  patch = std::move(second);
  return again;
}

}  // namespace ibmfair
