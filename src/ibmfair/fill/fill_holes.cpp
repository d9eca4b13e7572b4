#include "ibmfair/fill/fill_holes.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <mutex>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/fill/harmonic_extension.h"
#include "ibmfair/fill/hole_filler.h"
#include "ibmfair/fill/hole_groups.h"
#include "ibmfair/fill/intersections.h"

namespace ibmfair {
namespace {

// Limits of the number of new vertices if the options set none: for all holes, and for one hole of
// n edges, least_per_hole + most_per_squared_edge * n^2.
constexpr Index least_limit = 100'000;
constexpr double most_per_squared_edge = 0.5;
constexpr double least_per_hole = 64;

/// The most new vertices of each group. A hole of n edges needs about n^2 / 10; a badly shaped hole
/// that would take many more must not use up the vertices that other holes need.
std::vector<Index> shares(const std::vector<std::vector<Index>>& groups,
                          const std::vector<Hole>& holes, const FillOptions& options,
                          Index vertex_count) {
  const bool given = options.most_new_vertices > 0;
  const Index limit = given ? options.most_new_vertices : std::max(least_limit, vertex_count);
  std::vector<double> need;
  double all = 0;
  for (const auto& group : groups) {
    double edges = 0;
    for (const Index h : group) {
      edges += holes[h].edges();
    }
    need.push_back(edges * edges);
    all += need.back();
  }
  std::vector<Index> result;
  result.reserve(need.size());
  for (const double part : need) {
    const double share = limit * (part / all);
    result.push_back(static_cast<Index>(
        given ? share : std::min(share, least_per_hole + most_per_squared_edge * part)));
  }
  return result;
}

/// Collects the patches of all groups; their vertices and triangles are numbered in this order.
class Assembly {
 public:
  Assembly(const Points& X, Filling& filling) : filling_(filling), vertex_count_(X.rows()) {
    filling.X = X;
  }

  void add(FilledGroup& group) {
    for (HoleReport& report : group.reports) {
      filling_.holes[report.hole] = std::move(report);
    }
    if (!group.patch) {
      return;
    }
    Patch& patch = *group.patch;
    for (Index v = 0; v < patch.own_from; ++v) {
      if (patch.free[v]) {
        filling_.X.row(patch.mesh_vertex[v]) = patch.X.row(v);
      }
    }
    const std::vector<Index> nearest = nearest_rim_edges(patch);
    for (Index t = 0; t < patch.net.size(); ++t) {
      for (const Index v : patch.net[t]) {
        corners_.push_back(v < patch.own_from ? patch.mesh_vertex[v]
                                              : static_cast<Index>(vertex_count_ + own_count_) + v -
                                                    patch.own_from);
      }
      const Index hole = group.hole_of_rim[nearest[t]];
      filling_.model_triangle.push_back(patch.rim[nearest[t]].mesh_triangle);
      filling_.hole_of_triangle.push_back(hole);
      ++filling_.holes[hole].new_triangles;
    }
    count_vertices(group, nearest);
    own_count_ += patch.own_size();
    filling_.patches.push_back(std::move(patch));
  }

  void finish() {
    filling_.new_F = Eigen::Map<const Triangles>(corners_.data(),
                                                 static_cast<Eigen::Index>(corners_.size() / 3), 3);
    filling_.new_X.resize(own_count_, 3);
    Eigen::Index row = 0;
    for (const Patch& patch : filling_.patches) {
      filling_.new_X.middleRows(row, patch.own_size()) = patch.X.bottomRows(patch.own_size());
      row += patch.own_size();
    }
  }

 private:
  void count_vertices(const FilledGroup& group, const std::vector<Index>& nearest) {
    const Patch& patch = *group.patch;
    std::vector<Index> hole(static_cast<std::size_t>(patch.own_size()), -1);
    for (Index t = 0; t < patch.net.size(); ++t) {
      for (const Index v : patch.net[t]) {
        if (v >= patch.own_from && hole[v - patch.own_from] < 0) {
          hole[v - patch.own_from] = group.hole_of_rim[nearest[t]];
          ++filling_.holes[hole[v - patch.own_from]].new_vertices;
        }
      }
    }
  }

  Filling& filling_;
  Eigen::Index vertex_count_;
  Eigen::Index own_count_ = 0;
  std::vector<Index> corners_;
};

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

void count_intersections(const Topology& topology, Filling& filling) {
  const FilledMesh filled = filled_mesh(topology, filling);
  const auto first = static_cast<Index>(topology.F.rows());
  for (const auto& [t, u] : patch_intersections(filled.X, filled.F, first)) {
    const Index hole = filling.hole_of_triangle[u - first];
    ++filling.holes[hole].intersections;
    if (t >= first && filling.hole_of_triangle[t - first] != hole) {
      ++filling.holes[filling.hole_of_triangle[t - first]].intersections;
    }
  }
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
  const std::vector<Hole> holes = find_holes(X, topology);
  require_known_holes(holes, choice);
  Filling filling;
  std::vector<Index> chosen;
  for (const Hole& hole : holes) {
    filling.holes.push_back(report_of(hole.id, HoleStatus::skipped, reason_to_skip(hole, choice)));
    if (filling.holes.back().reason.empty()) {
      chosen.push_back(hole.id);
    }
  }
  const auto groups = group_holes(topology, holes, chosen, options.rim_smooth);
  auto results =
      fill_groups(HoleFiller(X, topology, holes, options), groups,
                  shares(groups, holes, options, static_cast<Index>(X.rows())), options.on_hole);
  Assembly assembly(X, filling);
  for (FilledGroup& group : results) {
    assembly.add(group);
  }
  assembly.finish();
  if (filling.new_F.rows() > 0) {
    const Stopwatch watch(filling.audit_seconds);
    count_intersections(topology, filling);
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
