#include "ibmfair/fill/fill_holes.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/fill/bridges.h"
#include "ibmfair/fill/filling_assembly.h"
#include "ibmfair/fill/fins.h"
#include "ibmfair/fill/harmonic_extension.h"
#include "ibmfair/fill/hole_filler.h"
#include "ibmfair/fill/hole_groups.h"
#include "ibmfair/fill/islands.h"
#include "ibmfair/fill/sharp_lines.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double least_edge = 1e-9;     // of a patch, in diagonals of the mesh
constexpr double least_need = 1e-9;     // edges of a hole without length; never all are zero
constexpr Index least_limit = 100'000;  // of the new vertices, if the options set no limit

void require_usable_edge_length(const Points& X, double edge_length) {
  const double least = least_edge * bounding_box_size(X).norm();
  if (edge_length != 0 && !(edge_length > 0 && edge_length >= least)) {
    throw BadOption(
        fmt::format("--edge-length: {:.3g} is too short for this mesh; it must be at least {:.3g}",
                    edge_length, least));
  }
}

/// The most new vertices of each group. A hole of n edges needs about n^2 / 10, if they are as long
/// as those of the patch; a badly shaped hole that would take many more must not use up the
/// vertices that other holes need.
std::vector<Index> shares(const std::vector<std::vector<Index>>& groups,
                          const std::vector<Hole>& holes, const FillOptions& options,
                          Index vertex_count) {
  const Index limit = options.most_new_vertices > 0 ? options.most_new_vertices
                                                    : std::max(least_limit, vertex_count);
  std::vector<double> need;
  double all = 0, longest = std::numeric_limits<double>::min();
  for (const Hole& hole : holes) {
    longest = std::max(longest, hole.perimeter);
  }
  for (const auto& group : groups) {
    double edges = 0;
    for (const Index h : group) {
      edges += options.edge_length > 0 ? holes[h].perimeter / longest : holes[h].edges();
    }
    edges = std::max(edges, least_need);
    need.push_back(edges * edges);
    all += need.back();
  }
  std::vector<Index> result;
  result.reserve(need.size());
  for (const double part : need) {
    result.push_back(static_cast<Index>(limit * (part / all)));
  }
  return result;
}

/// Counts the finished holes and calls the observer.
class HoleCounter {
 public:
  HoleCounter(const std::vector<std::vector<Index>>& groups, const HoleObserver& observer)
      : observer_(observer) {
    for (const auto& group : groups) {
      all_ += static_cast<std::int64_t>(group.size());
    }
    add(0);
  }

  void add(std::size_t holes) {
    if (observer_) {
      const std::lock_guard lock(mutex_);
      finished_ += static_cast<std::int64_t>(holes);
      observer_(finished_, all_);
    }
  }

 private:
  const HoleObserver& observer_;
  std::mutex mutex_;
  std::int64_t finished_ = 0, all_ = 0;
};

std::vector<FilledGroup> fill_groups(const HoleFiller& filler,
                                     const std::vector<std::vector<Index>>& groups,
                                     const std::vector<Index>& limits,
                                     const HoleObserver& observer) {
  HoleCounter counter(groups, observer);
  std::vector<std::vector<FilledGroup>> results(groups.size());
  std::vector<std::exception_ptr> errors(groups.size());
  parallel_tasks(static_cast<std::int64_t>(groups.size()), [&](std::int64_t i) {
    try {
      results[i] = filler.cut(groups[i], limits[i]);
      for (FilledGroup& result : results[i]) {
        filler.finish(result);
        counter.add(result.reports.size());
      }
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors) {
    if (error) {
      std::rethrow_exception(error);
    }
  }
  std::vector<FilledGroup> all;
  for (std::vector<FilledGroup>& some : results) {
    std::ranges::move(some, std::back_inserter(all));
  }
  return all;
}

/// A topology, or a copy of it without its fins.
class SurfaceWithoutFins {
 public:
  explicit SurfaceWithoutFins(const Topology& whole) : whole_(whole) {
    for (std::vector<Index> fins = find_fins(topology()); !fins.empty();
         fins = find_fins(topology())) {
      copy_ = without_triangles(topology(), fins);
      fins_.insert(fins_.end(), fins.begin(), fins.end());
    }
  }

  const Topology& topology() const { return copy_ ? *copy_ : whole_; }

  void reverse(const std::vector<std::uint8_t>& components) {
    copy_ = with_reversed_components(topology(), components);
  }

  const std::vector<Index>& fins() const { return fins_; }

  /// Adds each fin to the report of a hole at whose rim it stands.
  void name_fins(const std::vector<Hole>& holes, std::vector<HoleReport>& reports) const {
    for (const Index t : fins_) {
      const auto x = whole_.F.row(t);
      const auto at_rim = std::ranges::find_if(holes, [&](const Hole& hole) {
        return std::ranges::any_of(hole.loop, [&](Index v) { return (x.array() == v).any(); });
      });
      if (at_rim != holes.end()) {
        reports[at_rim->id].protruding.push_back(t);
      }
    }
  }

 private:
  const Topology& whole_;
  std::optional<Topology> copy_;
  std::vector<Index> fins_;
};

/// Removes the ends of bridges from the relation, and lets one end of each surround the other.
std::vector<Index> with_bridges(std::vector<Index> surrounding, const BridgePlan& plan) {
  const auto is_end = [&](Index hole) { return hole >= 0 && plan.other_end[hole] >= 0; };
  for (std::size_t i = 0; i < surrounding.size(); ++i) {
    const auto hole = static_cast<Index>(i);
    if (is_end(hole) || is_end(surrounding[i])) {
      surrounding[i] = is_end(hole) && plan.other_end[i] < hole ? plan.other_end[i] : -1;
    }
  }
  return surrounding;
}

/// Orients the patches of other holes like the mesh around them, which was reversed for a bridge,
/// and notes the bridges in the reports.
void conclude(const BridgePlan& plan, const std::vector<Hole>& holes, Filling& filling) {
  for (Eigen::Index t = 0; t < filling.new_F.rows(); ++t) {
    const Index hole = filling.hole_of_triangle[static_cast<std::size_t>(t)];
    if (plan.other_end[hole] < 0 && plan.reversed[holes[hole].component]) {
      std::swap(filling.new_F(t, 1), filling.new_F(t, 2));
    }
  }
  for (HoleReport& report : filling.holes) {
    report.bridged_to = plan.other_end[report.hole];
  }
}

/// Chooses the islands in holes that are to be filled, too, unless the holes to fill are given one
/// by one. Returns `surrounding` for the islands that are joined to the mesh around them.
std::vector<Index> choose_islands(std::vector<Index> surrounding, const HoleChoice& choice,
                                  std::vector<HoleReport>& reports) {
  for (std::size_t i = 0; i < surrounding.size(); ++i) {
    if (surrounding[i] < 0) {
      continue;
    }
    if (!reports[surrounding[i]].reason.empty()) {
      surrounding[i] = -1;
    } else if (choice.only.empty()) {
      reports[i].reason.clear();
    } else if (!reports[i].reason.empty()) {
      surrounding[i] = -1;
    }
  }
  return surrounding;
}

}  // namespace

std::string_view name_of(HoleStatus status) {
  switch (status) {
    case HoleStatus::filled:
      return "filled";
    case HoleStatus::not_converged:
      return "not converged";
    case HoleStatus::coarse:
      return "coarse";
    case HoleStatus::failed:
      return "failed";
    case HoleStatus::skipped:
      return "skipped";
  }
  return "unknown";
}

FilledMesh filled_mesh(const Topology& topology, const Filling& filling) {
  FilledMesh filled{Points(filling.X.rows() + filling.new_X.rows(), 3),
                    Triangles(topology.F.rows() + filling.new_F.rows(), 3)};
  filled.X << filling.X, filling.new_X;
  filled.F << topology.F, filling.new_F;
  return filled;
}

Filling fill_holes(const Points& X, const Topology& topology, const HoleChoice& choice,
                   const FillOptions& options) {
  options.fairing.validate();
  require_usable_edge_length(X, options.edge_length);
  SurfaceWithoutFins surface(topology);
  std::vector<Hole> holes = find_holes(X, surface.topology());
  require_known_holes(holes, choice);
  const BridgePlan plan = plan_bridges(X, surface.topology(), holes, choice);
  if (plan.reverses_any()) {
    surface.reverse(plan.reversed);
    holes = find_holes(X, surface.topology());
  }
  Filling filling;
  double audit_seconds = 0;
  for (const Hole& hole : holes) {
    filling.holes.push_back(report_of(hole.id, HoleStatus::skipped, reason_to_skip(hole, choice)));
  }
  for (const Hole& hole : holes) {
    if (plan.other_end[hole.id] >= 0) {
      filling.holes[hole.id].reason.clear();
    }
  }
  const std::vector<Index> surrounding = choose_islands(
      with_bridges(surrounding_holes(X, surface.topology(), holes), plan), choice, filling.holes);
  std::vector<Index> chosen;
  for (const HoleReport& hole : filling.holes) {
    if (hole.reason.empty()) {
      chosen.push_back(hole.hole);
    }
  }
  const auto groups =
      group_holes(surface.topology(), holes, chosen, options.rim_smooth, surrounding);
  FillOptions decided = options;
  if (options.choose_sharp_angle) {
    decided.sharp_angle = sharp_angle_of(X, surface.topology());
  }
  const HoleFiller filler(X, surface.topology(), holes, surrounding, plan.other_end, decided);
  auto results =
      fill_groups(filler, groups, shares(groups, holes, options, static_cast<Index>(X.rows())),
                  options.on_hole);
  {
    const Stopwatch watch(audit_seconds);
    filling = assemble_without_intersections(X, topology, filling.holes, filler, results);
  }
  conclude(plan, holes, filling);
  surface.name_fins(holes, filling.holes);
  filling.fins = surface.fins();
  filling.audit_seconds = audit_seconds;
  for (FilledGroup& group : results) {
    if (group.patch) {
      filling.patches.push_back(std::move(*group.patch));
    }
  }
  return filling;
}

std::vector<Index> Filling::rim() const {
  std::vector<Index> all;
  for (const Patch& patch : patches) {
    const std::vector<Index> part = rim_vertices(patch);
    all.insert(all.end(), part.begin(), part.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Eigen::MatrixXd Filling::extend(const Eigen::MatrixXd& at_rim) const {
  const std::vector<Index> all = rim();
  Eigen::MatrixXd values(new_X.rows(), at_rim.cols());
  Eigen::Index row = 0;
  for (const Patch& patch : patches) {
    const std::vector<Index> part = rim_vertices(patch);
    Eigen::MatrixXd own(static_cast<Eigen::Index>(part.size()), at_rim.cols());
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto place = std::lower_bound(all.begin(), all.end(), part[i]) - all.begin();
      own.row(static_cast<Eigen::Index>(i)) = at_rim.row(place);
    }
    values.middleRows(row, patch.own_size()) = extend_harmonically(patch, own);
    row += patch.own_size();
  }
  return values;
}

}  // namespace ibmfair
