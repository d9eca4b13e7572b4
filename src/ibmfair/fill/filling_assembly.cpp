#include "ibmfair/fill/filling_assembly.h"

#include <fmt/format.h>

#include "ibmfair/base/parallel.h"
#include "ibmfair/fill/intersections.h"

namespace ibmfair {
namespace {

/// Collects the patches of all groups; their vertices and triangles are numbered in this order.
class Assembly {
 public:
  Assembly(const Points& X, Filling& filling) : filling_(filling), vertex_count_(X.rows()) {
    filling.X = X;
  }

  void add(const FilledGroup& group) {
    for (const HoleReport& report : group.reports) {
      filling_.holes[report.hole] = report;
    }
    if (!group.patch) {
      return;
    }
    const Patch& patch = *group.patch;
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
    new_X_.push_back(patch.X.bottomRows(patch.own_size()));
  }

  void finish() {
    filling_.new_F = Eigen::Map<const Triangles>(corners_.data(),
                                                 static_cast<Eigen::Index>(corners_.size() / 3), 3);
    filling_.new_X.resize(own_count_, 3);
    Eigen::Index row = 0;
    for (const Points& part : new_X_) {
      filling_.new_X.middleRows(row, part.rows()) = part;
      row += part.rows();
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
  std::vector<Points> new_X_;
};

/// The patches of all groups together, without `Filling::patches`.
Filling assembled(const Points& X, const std::vector<HoleReport>& others,
                  const std::vector<FilledGroup>& groups) {
  Filling filling;
  filling.holes = others;
  Assembly assembly(X, filling);
  for (const FilledGroup& group : groups) {
    assembly.add(group);
  }
  assembly.finish();
  return filling;
}

void count_intersections(const Topology& topology, Filling& filling) {
  if (filling.new_F.rows() == 0) {
    return;
  }
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

std::int64_t intersections_of(const FilledGroup& group, const Filling& filling) {
  std::int64_t count = 0;
  for (const Index hole : group.holes) {
    count += filling.holes[hole].intersections;
  }
  return count;
}

class Disentangling {
 public:
  Disentangling(const Points& X, const Topology& topology, const std::vector<HoleReport>& others,
                const HoleFiller& filler)
      : X_(X), topology_(topology), others_(others), filler_(filler) {}

  Filling run(std::vector<FilledGroup>& groups) {
    while (true) {
      Filling filling = counted(groups);
      std::vector<Index> entangled;
      for (std::size_t i = 0; i < groups.size(); ++i) {
        if (intersections_of(groups[i], filling) > 0 && filler_.has_further_method(groups[i])) {
          entangled.push_back(static_cast<Index>(i));
        }
      }
      if (!entangled.empty() && plain_.empty()) {
        find_plain_intersections(groups);
      }
      std::erase_if(entangled, [this](Index i) { return plain_[i] != 0; });
      if (entangled.empty()) {
        return filling;
      }
      parallel_tasks(static_cast<std::int64_t>(entangled.size()), [&](std::int64_t k) {
        FilledGroup& group = groups[entangled[k]];
        filler_.finish_otherwise(group, fmt::format("{} pairs of triangles intersect",
                                                    intersections_of(group, filling)));
      });
    }
  }

 private:
  Filling counted(const std::vector<FilledGroup>& groups) const {
    Filling filling = assembled(X_, others_, groups);
    count_intersections(topology_, filling);
    return filling;
  }

  void find_plain_intersections(const std::vector<FilledGroup>& groups) {
    std::vector<FilledGroup> plain;
    for (const FilledGroup& group : groups) {
      plain.push_back(group);
      plain.back().patch = group.plain;
    }
    const Filling filling = counted(plain);
    for (const FilledGroup& group : groups) {
      plain_.push_back(intersections_of(group, filling) > 0 ? 1 : 0);
    }
  }

  const Points& X_;
  const Topology& topology_;
  const std::vector<HoleReport>& others_;
  const HoleFiller& filler_;
  std::vector<std::uint8_t> plain_;  // per group; empty until it is needed
};

}  // namespace

Filling assemble_without_intersections(const Points& X, const Topology& topology,
                                       const std::vector<HoleReport>& others,
                                       const HoleFiller& filler, std::vector<FilledGroup>& groups) {
  return Disentangling(X, topology, others, filler).run(groups);
}

}  // namespace ibmfair
