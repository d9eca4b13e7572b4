#include "ibmfair/fill/patch_audit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

std::uint64_t directed(Index a, Index b) {
  return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
}

Vec3 area_vector(const Points& X, Index a, Index b, Index c) {
  return double_area_vector(X.row(a), X.row(b), X.row(c));
}

/// The angle between the normals of two triangles that run along their common edge in opposite
/// directions, radians.
double bend(const Vec3& N0, const Vec3& N1) {
  return std::atan2(N0.cross(N1).norm(), N0.dot(N1));
}

Bends summary(std::vector<double> angles) {
  if (angles.empty()) {
    return {};
  }
  return {median(angles), *std::max_element(angles.begin(), angles.end())};
}

/// The double area vectors of the surrounding triangles, found by their directed edges.
class Surroundings {
 public:
  explicit Surroundings(const Patch& patch) {
    for (const auto x : patch.surroundings.rowwise()) {
      const Vec3 N = area_vector(patch.X, x[0], x[1], x[2]);
      for (int i = 0; i < 3; ++i) {
        normal_[directed(x[i], x[(i + 1) % 3])] = N;
      }
    }
  }

  /// The double area vector of the triangle beyond the edge of a triangle that runs from a to b;
  /// zero if there is none.
  Vec3 beyond(Index a, Index b) const {
    if (const auto it = normal_.find(directed(b, a)); it != normal_.end()) {
      return it->second;
    }
    const auto it = normal_.find(directed(a, b));  // the orientations of the two disagree
    return it != normal_.end() ? Vec3(-it->second) : Vec3(Vec3::Zero());
  }

 private:
  std::unordered_map<std::uint64_t, Vec3> normal_;
};

Bends bends_at(const Patch& patch, const Surroundings& around,
               const std::vector<std::uint8_t>& at_vertex) {
  std::vector<double> angles;
  for (const auto x : patch.surroundings.rowwise()) {
    const Vec3 N = area_vector(patch.X, x[0], x[1], x[2]);
    for (int i = 0; i < 3; ++i) {
      const Index a = x[i], b = x[(i + 1) % 3];
      if (a < b && (at_vertex[a] || at_vertex[b])) {
        const Vec3 other = around.beyond(a, b);  // -N: the triangle itself, at an open edge
        if (other != Vec3::Zero() && N != Vec3::Zero() && other != -N) {
          angles.push_back(bend(N, other));
        }
      }
    }
  }
  return summary(std::move(angles));
}

}  // namespace

std::vector<Index> nearest_rim_edges(const Patch& patch) {
  std::unordered_map<std::uint64_t, Index> rim;
  for (std::size_t i = 0; i < patch.rim.size(); ++i) {
    rim[directed(patch.rim[i].a, patch.rim[i].b)] = static_cast<Index>(i);
  }
  std::vector<Index> nearest(static_cast<std::size_t>(patch.net.size()), -1);
  std::vector<Index> front;
  for (Index t = 0; t < patch.net.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto it = rim.find(directed(patch.net.start({t, i}), patch.net.end({t, i})));
      if (it != rim.end() && patch.net.other_side({t, i}).triangle < 0 && nearest[t] < 0) {
        nearest[t] = it->second;
        front.push_back(t);
      }
    }
  }
  for (std::size_t i = 0; i < front.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const NetEdge e{front[i], k};
      const Index next = patch.net.other_side(e).triangle;
      if (next >= 0 && nearest[next] < 0 &&
          !patch.creases.contains(patch.net.start(e), patch.net.end(e))) {
        nearest[next] = nearest[front[i]];
        front.push_back(next);
      }
    }
  }
  return nearest;
}

SeamAudit audit_seam(const Patch& patch, const std::vector<Index>& nearest,
                     const std::vector<std::uint8_t>& chosen) {
  const Surroundings around(patch);
  std::vector<std::uint8_t> at_rim(static_cast<std::size_t>(patch.size()), 0);
  std::vector<double> seam;
  SeamAudit audit;
  for (Index t = 0; t < patch.net.size(); ++t) {
    if (!chosen[nearest[t]]) {
      continue;
    }
    const auto& x = patch.net[t];
    const Vec3 N = area_vector(patch.X, x[0], x[1], x[2]);
    for (int i = 0; i < 3; ++i) {
      const NetEdge e{t, i};
      const NetEdge o = patch.net.other_side(e);
      const Index a = patch.net.start(e), b = patch.net.end(e);
      if (o.triangle >= 0 && a > b) {
        continue;  // counted from the other side
      }
      const Vec3 other =
          o.triangle < 0 ? around.beyond(a, b) : area_vector(patch.X, patch.net.opposite(o), b, a);
      const double angle = bend(N, other);
      const bool is_fold = angle > std::numbers::pi - fold_angle && !patch.creases.contains(a, b);
      audit.folds += is_fold ? 1 : 0;
      if (o.triangle < 0) {
        seam.push_back(angle);
        at_rim[a] = at_rim[b] = 1;
      }
    }
  }
  audit.seam = summary(std::move(seam));
  audit.surroundings = bends_at(patch, around, at_rim);
  return audit;
}

PatchSize audit_size(const Patch& patch, const std::vector<Index>& nearest,
                     const std::vector<std::uint8_t>& chosen) {
  PatchSize size;
  Eigen::AlignedBox3d box;
  for (Index t = 0; t < patch.net.size(); ++t) {
    if (chosen[nearest[t]]) {
      const auto& x = patch.net[t];
      size.area += area_vector(patch.X, x[0], x[1], x[2]).norm() / 2;
      for (const Index v : x) {
        box.extend(patch.X.row(v).transpose());
      }
    }
  }
  size.diameter = box.isEmpty() ? 0 : box.diagonal().norm();
  return size;
}

}  // namespace ibmfair
