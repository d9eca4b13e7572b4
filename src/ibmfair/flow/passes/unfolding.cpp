#include "ibmfair/flow/passes/unfolding.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

class FoldedPatchFinder {
 public:
  FoldedPatchFinder(const Points& X, const Topology& topology, const CompressedRows& rings,
                    const Unknowns& unknowns, const MeshParts& parts, double flat)
      : X_(X),
        topology_(topology),
        rings_(rings),
        unknowns_(unknowns),
        parts_(parts),
        flat_(flat),
        wanted_(static_cast<std::size_t>(topology.vertex_count), 0) {}

  std::vector<VertexPatch> patches() {
    want_vertices_at_folds();
    std::vector<VertexPatch> found = patches_of(wanted_, rings_, unknowns_, parts_);
    std::erase_if(found, [&](const VertexPatch& patch) {
      return patch.size() > tuning.clean_up.largest_fold ||
             !is_flat_around(patch, X_, topology_, rings_, flat_);
    });
    return found;
  }

 private:
  bool may_move(Index v) const {
    return is_oriented_interior(topology_, v) && unknowns_.unknown[v] >= 0 &&
           unknowns_.unknown[v] < unknowns_.size();
  }

  void want(Index v) { wanted_[v] = may_move(v) ? 1 : 0; }

  /// Flags the vertices at foldovers and their neighbours.
  void want_vertices_at_folds() {
    const std::vector<std::uint8_t> folded = folded_hinges(X_, topology_, tuning.clean_up.fold);
    for (auto fold = std::find(folded.begin(), folded.end(), 1); fold != folded.end();
         fold = std::find(fold + 1, folded.end(), 1)) {
      for (const Index v :
           {topology_.H(fold - folded.begin(), 0), topology_.H(fold - folded.begin(), 1)}) {
        if (may_move(v)) {
          want(v);
          for (const Index q : rings_[v]) {
            want(q);
          }
        }
      }
    }
  }

  const Points& X_;
  const Topology& topology_;
  const CompressedRows& rings_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  const double flat_;
  std::vector<std::uint8_t> wanted_;  // #V
};

}  // namespace

std::vector<VertexPatch> find_folded_patches(const Points& X, const Topology& topology,
                                             const CompressedRows& rings, const Unknowns& unknowns,
                                             const MeshParts& parts, double flat) {
  return FoldedPatchFinder(X, topology, rings, unknowns, parts, flat).patches();
}

bool is_flat_around(const VertexPatch& patch, const Points& X, const Topology& topology,
                    const CompressedRows& rings, double flat) {
  const auto inside = [&](Index v) { return std::binary_search(patch.begin(), patch.end(), v); };
  std::vector<Index> around;
  for (const Index v : patch) {
    for (const Index q : rings[v]) {
      if (!inside(q)) {
        const auto star = topology.stars[q];
        around.insert(around.end(), star.begin(), star.end());
      }
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (const Index t : around) {
    const auto x = topology.F.row(t);
    if (std::none_of(x.begin(), x.end(), inside)) {
      const Vec3 N = double_area_vector(X, topology.F, t);
      sum += N;
      length += N.norm();
    }
  }
  return sum.norm() > flat * length;
}

void even_out(const VertexPatch& patch, const CompressedRows& rings, Points& X) {
  for (int i = 0; i < tuning.clean_up.sweeps; ++i) {
    for (const Index v : patch) {
      Vec3 mean = Vec3::Zero();
      for (const Index q : rings[v]) {
        mean += X.row(q);
      }
      X.row(v) = mean / static_cast<double>(rings[v].size());
    }
  }
}

}  // namespace ibmfair
