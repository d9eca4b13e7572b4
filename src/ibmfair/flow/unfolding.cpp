#include "ibmfair/flow/unfolding.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "ibmfair/flow/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

// Chosen on scans with noise of 0.2 mean edge lengths (tools/denoise_table): around flaps that the
// noise made the share is 0.9 to 1, around folds that the scan had without noise 0.85 or less.
constexpr double flat_enough = 0.88;  // what the normals around keep of their lengths when added
constexpr double fold_to_undo = std::numbers::pi / 3;  // the dihedral angle, at most
constexpr std::size_t most_vertices = 200;  // of a patch: flaps are small, and noise is all around
constexpr int sweeps = 40;                  // over a patch of a few rings

class FlapFinder {
 public:
  FlapFinder(const Points& X, const Topology& topology, const Rows& rings, const Unknowns& unknowns,
             const MeshParts& parts)
      : X_(X),
        topology_(topology),
        rings_(rings),
        unknowns_(unknowns),
        parts_(parts),
        wanted_(static_cast<std::size_t>(topology.vertex_count), 0) {}

  /// Patches of vertices to even out.
  std::vector<std::vector<Index>> patches() {
    std::vector<std::vector<Index>> found;
    for (const Index v : vertices_at_folds()) {
      if (wanted_[v] != 0) {
        std::vector<Index> patch = take_patch(v);
        if (patch.size() <= most_vertices && is_flat_around(patch)) {
          found.push_back(std::move(patch));
        }
      }
    }
    return found;
  }

 private:
  bool may_move(Index v) const {
    return topology_.kind[v] == VertexKind::interior && !topology_.twisted[v] &&
           unknowns_.unknown[v] >= 0 && unknowns_.unknown[v] < unknowns_.size();
  }

  void want(Index v) { wanted_[v] = may_move(v) ? 1 : 0; }

  /// Those that may move, in order of the hinges; they and their neighbours are wanted.
  std::vector<Index> vertices_at_folds() {
    const std::vector<std::uint8_t> folded = folded_hinges(X_, topology_, fold_to_undo);
    std::vector<Index> found;
    for (auto fold = std::find(folded.begin(), folded.end(), 1); fold != folded.end();
         fold = std::find(fold + 1, folded.end(), 1)) {
      for (const Index v :
           {topology_.H(fold - folded.begin(), 0), topology_.H(fold - folded.begin(), 1)}) {
        if (may_move(v)) {
          found.push_back(v);
          want(v);
          for (const Index q : rings_[v]) {
            want(q);
          }
        }
      }
    }
    return found;
  }

  /// The wanted vertices that hang together with v, no longer wanted, in increasing order.
  std::vector<Index> take_patch(Index v) {
    std::vector<Index> patch{v};
    wanted_[v] = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const Index q : rings_[patch[i]]) {
        if (wanted_[q] != 0) {
          wanted_[q] = 0;
          patch.push_back(q);
        }
      }
    }
    std::sort(patch.begin(), patch.end());
    return patch;
  }

  /// Of the triangles at the rim that the patch does not move.
  bool is_flat_around(const std::vector<Index>& patch) const {
    const auto inside = [&](Index v) { return std::binary_search(patch.begin(), patch.end(), v); };
    std::vector<Index> around;
    for (const Index v : patch) {
      for (const Index q : rings_[v]) {
        if (!inside(q)) {
          if (!parts_.owns_vertex(q)) {  // its star may not be all here
            return false;
          }
          const auto star = topology_.stars[q];
          around.insert(around.end(), star.begin(), star.end());
        }
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    Vec3 sum = Vec3::Zero();
    double length = 0;
    for (const Index t : around) {
      const auto x = topology_.F.row(t);
      if (std::none_of(x.begin(), x.end(), inside)) {
        const Vec3 N = double_area_vector(X_, topology_.F, t);
        sum += N;
        length += N.norm();
      }
    }
    return sum.norm() > flat_enough * length;
  }

  const Points& X_;
  const Topology& topology_;
  const Rows& rings_;
  const Unknowns& unknowns_;
  const MeshParts& parts_;
  std::vector<std::uint8_t> wanted_;  // #V
};

void even_out(const std::vector<Index>& patch, const Rows& rings, Points& X) {
  for (int i = 0; i < sweeps; ++i) {
    for (const Index v : patch) {
      Vec3 mean = Vec3::Zero();
      for (const Index q : rings[v]) {
        mean += X.row(q);
      }
      X.row(v) = mean / static_cast<double>(rings[v].size());
    }
  }
}

}  // namespace

bool unfolding_moves(const Points& X, const Topology& topology, const Rows& rings,
                     const Unknowns& unknowns, const MeshParts& parts, Points& move) {
  const auto patches = FlapFinder(X, topology, rings, unknowns, parts).patches();
  if (!parts.any(!patches.empty())) {
    return false;
  }
  move = Points::Zero(unknowns.size(), 3);
  Points Y = X;
  for (const std::vector<Index>& patch : patches) {
    even_out(patch, rings, Y);
    for (const Index v : patch) {
      move.row(unknowns.unknown[v]) = Y.row(v) - X.row(v);
    }
  }
  return true;
}

}  // namespace ibmfair
