#include "ibmfair/fill/hole_filler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/fill/curvature_continuation.h"
#include "ibmfair/fill/group_limits.h"
#include "ibmfair/fill/least_area.h"
#include "ibmfair/fill/linear_fairing.h"
#include "ibmfair/fill/refine.h"
#include "ibmfair/fill/rim_directions.h"

namespace ibmfair {
namespace {

constexpr int sweeps_before_repetition = 2;  // of relaxation, before linear fairing is repeated

std::vector<std::uint8_t> rim_of(const FilledGroup& group, Index hole) {
  std::vector<std::uint8_t> chosen(group.hole_of_rim.size());
  std::transform(group.hole_of_rim.begin(), group.hole_of_rim.end(), chosen.begin(),
                 [hole](Index h) { return h == hole ? 1 : 0; });
  return chosen;
}

/// The reason why a hole stays open. That a hole is a crack is reason enough; if only a part of it
/// is a crack, or if it is a slit, this is said as well.
std::string with_crack(const Hole& hole, const std::string& reason) {
  const std::string crack = describe_crack(hole);
  if (crack.empty()) {
    return reason;
  }
  return hole.crack.kind == LoopKind::crack ? "it is " + crack
                                            : fmt::format("{}; it is {}", reason, crack);
}

/// Whether the method makes patches of the kind that the options ask for. Creases come on top of
/// the methods for holes without creases.
bool is_asked_for(const FilledGroup& group, const PatchMethod& method) {
  const bool creased = group.methods.front().kind == PatchKind::creased;
  return method.kind == PatchKind::creased || method.kind == group.methods[creased ? 1 : 0].kind;
}

const char* quality_of(Continuity continuity) {
  return continuity == Continuity::curvature  ? "stationary energy"
         : continuity == Continuity::tangents ? "linear fairing"
                                              : "least area";
}

Index count_folds(const Patch& patch) {
  const std::vector<std::uint8_t> all(patch.rim.size(), 1);
  return audit_seam(patch, nearest_rim_edges(patch), all).folds;
}

}  // namespace

/// A patch made by one method.
struct HoleFiller::Attempt {
  Patch patch;
  FairingReport fairing = {};
  bool refined = true;  ///< false if the limit of new vertices ended the refinement
  bool converged = true;
  Index other_sheets = 0;  // CreasedPatch::other_sheets
  std::string flaw = {};   ///< the reason why the patch cannot be used; empty if it can
};

HoleReport report_of(Index hole, HoleStatus status, std::string reason) {
  HoleReport report;
  report.hole = hole;
  report.status = status;
  report.reason = std::move(reason);
  return report;
}

HoleFiller::HoleFiller(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
                       const std::vector<Index>& surrounding, const std::vector<Index>& bridges,
                       const FillOptions& options)
    : X_(X),
      topology_(topology),
      holes_(holes),
      surrounding_(surrounding),
      bridges_(bridges),
      options_(options) {}

/// The hole, or the two ends of a bridge if it is one of them.
std::vector<Index> HoleFiller::together_with(Index hole) const {
  const Index other = bridges_[hole];
  return other < 0 ? std::vector<Index>{hole}
                   : std::vector<Index>{std::min(hole, other), std::max(hole, other)};
}

std::vector<FilledGroup> HoleFiller::cut(const std::vector<Index>& group,
                                         Index most_vertices) const {
  std::vector<FilledGroup> results;
  try {
    results.push_back(cut_together(group, most_vertices));
    return results;
  } catch (const BadMesh& error) {
    if (group == together_with(group.front())) {
      results.emplace_back();
      for (const Index hole : group) {
        results.back().reports.push_back(
            report_of(hole, HoleStatus::failed, with_crack(holes_[hole], error.what())));
      }
      return results;
    }
  }
  for (const Index hole : group) {
    const std::vector<Index> part = together_with(hole);
    if (hole != part.front()) {
      continue;  // cut with the other end of its bridge
    }
    const auto share = most_vertices / static_cast<Index>(group.size() / part.size());
    for (FilledGroup& result : cut(part, share)) {
      results.push_back(std::move(result));
    }
  }
  return results;
}

FilledGroup HoleFiller::cut_together(const std::vector<Index>& group, Index most_vertices) const {
  FilledGroup result;
  result.holes = group;
  result.most_vertices = most_vertices;
  std::vector<PatchOutline> outlines;
  for (const Index hole : group) {
    if (!holes_[hole].closed) {
      throw BadMesh("its boundary ends at an edge of three or more triangles");
    }
    const Index outer = surrounding_[hole];
    if (outer >= 0 && std::ranges::find(group, outer) != group.end()) {
      continue;  // listed with the hole that surrounds it
    }
    for (auto& loop : simple_loops(holes_[hole].loop)) {
      result.hole_of_rim.insert(result.hole_of_rim.end(), loop.size(), hole);
      outlines.push_back({std::move(loop)});
    }
    for (const Index island : group) {
      if (surrounding_[island] == hole) {
        outlines.back().island = holes_[island].loop;
        outlines.back().tube = bridges_[island] == hole;
        result.hole_of_rim.insert(result.hole_of_rim.end(), holes_[island].loop.size(), island);
      }
    }
  }
  result.plain = cut_patch(X_, topology_, outlines, options_.rim_smooth);
  result.plain->inner_spacing = options_.edge_length;
  choose_methods(result);
  continue_creases(result);
  return result;
}

void HoleFiller::choose_methods(FilledGroup& group) const {
  if (options_.fair && options_.continuity == Continuity::curvature &&
      options_.choose_by_surroundings) {
    group.surroundings = look_around(X_, topology_, *group.plain);
  }
  group.methods =
      patch_methods(group.surroundings ? options_for(*group.surroundings, options_) : options_);
}

/// Looks for creases, and puts the method that continues them before the others.
void HoleFiller::continue_creases(FilledGroup& group) const {
  if (!(options_.sharp_angle > 0) || !options_.refine || options_.rim_smooth > 0) {
    return;
  }
  group.creases = look_for_creases(X_, topology_, *group.plain, options_.sharp_angle);
  if (group.creases && group.creases->network.flaw.empty()) {
    PatchMethod method = group.methods.front();
    method.kind = PatchKind::creased;
    method.name = (options_.fair ? method.fairing.laplacian : method.name) + " between creases";
    method.smooth_directions = method.continue_curvature = false;
    group.methods.insert(group.methods.begin(), std::move(method));
  }
}

std::optional<CreaseReport> HoleFiller::crease_report(const FilledGroup& group) const {
  if (!group.creases) {
    return std::nullopt;
  }
  CreaseReport report;
  report.ends = group.creases->ends;
  report.left_out = report.ends;
  report.rim_edges = std::ranges::count(group.creases->rim.on_crease, 1);
  const CreaseNetwork& network = group.creases->network;
  if (group.methods[group.method].kind == PatchKind::creased) {
    report.left_out -= std::ssize(group.creases->rim.ends);
    report.curves = std::ssize(network.curves);
    report.corners = std::ssize(network.corners);
  } else {
    report.reason = network.flaw.empty() ? group.rejected.front().reason : network.flaw;
  }
  return report;
}

void HoleFiller::finish(FilledGroup& group) const {
  if (!group.plain) {
    return;
  }
  const PatchLimits limits = limits_of(group, bridges_, options_);
  for (; group.method < group.methods.size(); ++group.method) {
    const PatchMethod& method = group.methods[group.method];
    Attempt made = attempt(group, method, limits);
    if (made.flaw.empty()) {
      accept(group, std::move(made));
      return;
    }
    group.rejected.push_back({method.name, made.flaw});
  }
  leave_open(group);
}

void HoleFiller::finish_otherwise(FilledGroup& group, const std::string& reason) const {
  group.rejected.push_back({group.methods[group.method].name, reason});
  group.reports.clear();
  group.patch.reset();
  ++group.method;
  finish(group);
}

HoleFiller::Attempt HoleFiller::attempt(const FilledGroup& group, const PatchMethod& method,
                                        const PatchLimits& limits) const {
  Attempt result{*group.plain};
  try {
    make(result, group, method, limits);
  } catch (const FactorizationFailed& error) {
    result.flaw = error.what();
    return result;
  } catch (const BadMesh& error) {
    result.flaw = error.what();
    return result;
  }
  const Patch& patch = result.patch;
  if (!patch.X.allFinite()) {
    result.flaw = "its coordinates are not finite";
  } else if (result.fairing.ran_away || limits.bound.is_exceeded(patch.X, patch.own_from)) {
    result.flaw = "it ran away from the hole";
  } else if (!result.converged) {
    result.flaw = "the fairing did not reach its tolerance";
  } else if (const double area = patch_area(patch); !(area <= limits.bound.area)) {
    result.flaw =
        std::isfinite(area / limits.bound.area)
            ? fmt::format("its area is {:.3g} times as large as allowed", area / limits.bound.area)
            : "its area is beyond the range of numbers";
  } else if (limits.start && options_.fair && method.kind != PatchKind::stationary &&
             method.kind != PatchKind::creased) {
    result.flaw = "more than a half sphere is missing, and it lies across the rim";
  } else if (options_.fair && is_asked_for(group, method) && count_folds(patch) > 0 &&
             count_folds(*group.plain) == 0) {
    result.flaw = "it is folded";
  }
  return result;
}

std::vector<RingShift> HoleFiller::shifts_of(const FilledGroup& group) const {
  const bool known = group.surroundings && group.surroundings->likeness;
  return known ? group.surroundings->shifts : direction_shifts(X_, topology_, *group.plain);
}

void HoleFiller::make(Attempt& attempt, const FilledGroup& group, const PatchMethod& method,
                      const PatchLimits& limits) const {
  if (method.kind == PatchKind::creased) {
    make_creased(attempt, group, method, limits);
    return;
  }
  Patch& patch = attempt.patch;
  const Points surroundings = patch.X;
  if (method.smooth_directions) {
    std::fill(patch.free.begin(), patch.free.begin() + patch.own_from, 0);
    smooth_directions(shifts_of(group), patch);
  }
  if (method.kind == PatchKind::stationary && options_.refine) {
    attempt.fairing = refine_and_fair(patch, method.fairing, limits, attempt.refined);
    attempt.converged = attempt.fairing.converged;
  } else {
    make_on_one_level(attempt, method, limits);
  }
  if (method.smooth_directions) {
    patch.X.topRows(patch.own_from) = surroundings;
  }
  if (method.continue_curvature && attempt.converged) {
    continue_curvature(X_, topology_, patch);
  }
}

void HoleFiller::make_creased(Attempt& attempt, const FilledGroup& group, const PatchMethod& method,
                              const PatchLimits& limits) const {
  FillOptions options = options_;
  options.fairing = method.fairing;
  options.smooth_directions = false;
  CreasedPatch made =
      fill_sheets(topology_, *group.plain, *group.creases, options, limits.most_vertices);
  attempt.patch = std::move(made.patch);
  attempt.fairing = made.fairing;
  attempt.refined = made.refined;
  attempt.other_sheets = made.other_sheets;
}

void HoleFiller::make_on_one_level(Attempt& attempt, const PatchMethod& method,
                                   const PatchLimits& limits) const {
  Patch& patch = attempt.patch;
  if (options_.refine && method.kind != PatchKind::plain) {
    attempt.refined = refine(patch, {1, false, limits.most_vertices});
  } else {
    split_taken_edges(patch);
  }
  if (method.kind == PatchKind::stationary) {
    attempt.fairing = fair(patch, method.fairing);
    attempt.converged = attempt.fairing.converged;
  } else if (method.kind == PatchKind::linear) {
    fair_linearly(patch);
    for (int i = 0; i < method.repetitions; ++i) {
      if (options_.refine) {
        attempt.refined = refine(patch, {1, true, limits.most_vertices}) && attempt.refined;
        even_out(patch, sweeps_before_repetition);
      }
      fair_linearly(patch);
    }
  } else if (method.kind == PatchKind::least_area) {
    attempt.converged = span_least_area(patch);
  }
}

void HoleFiller::accept(FilledGroup& group, Attempt attempt) const {
  const PatchMethod& method = group.methods[group.method];
  HoleReport report = report_of(0, HoleStatus::filled);
  report.method = method.name;
  report.surroundings = group.surroundings;
  report.rejected = group.rejected;
  report.creases = crease_report(group);
  report.fairing = attempt.fairing;
  if (!attempt.refined) {
    report.status = HoleStatus::coarse;
    report.reason = "the limit of new vertices (--max-new-vertices) ended its refinement";
  } else if (attempt.other_sheets > 0) {
    report.status = HoleStatus::not_converged;
    report.reason = "no patch of stationary energy could be used between some of its creases";
  } else if (options_.fair && !is_asked_for(group, method)) {
    report.status = HoleStatus::not_converged;
    report.reason = fmt::format("no patch of {} could be used", quality_of(options_.continuity));
  }
  report.protruding = attempt.patch.protruding;
  group.patch = std::move(attempt.patch);
  const std::vector<Index> nearest = nearest_rim_edges(*group.patch);
  const std::vector<Index> nearest_plain = nearest_rim_edges(*group.plain);
  for (const Index hole : group.holes) {
    const std::vector<std::uint8_t> chosen = rim_of(group, hole);
    report.hole = hole;
    report.seam = audit_seam(*group.patch, nearest, chosen);
    const PatchSize size = audit_size(*group.patch, nearest, chosen);
    report.diameter_ratio = size.diameter / holes_[hole].diameter;
    report.area_ratio = size.area / audit_size(*group.plain, nearest_plain, chosen).area;
    group.reports.push_back(report);
  }
}

void HoleFiller::leave_open(FilledGroup& group) const {
  std::vector<std::string> reasons;
  for (const RejectedPatch& rejected : group.rejected) {
    reasons.push_back(fmt::format("{}: {}", rejected.method, rejected.reason));
  }
  for (const Index hole : group.holes) {
    HoleReport report =
        report_of(hole, HoleStatus::failed,
                  with_crack(holes_[hole],
                             fmt::format("no patch could be used ({})", fmt::join(reasons, "; "))));
    report.rejected = group.rejected;
    group.reports.push_back(std::move(report));
  }
}

}  // namespace ibmfair
