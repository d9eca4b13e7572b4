#include "ibmfair/fill/refine.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

#include "ibmfair/fill/delaunay.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// An edge longer than this times the wanted length is split. The halves of slightly longer edges
/// are not much shorter than wanted, and the mean edge length comes out close to the wanted length.
constexpr double too_long = 1.45;
constexpr double grading = 0.5;  // growth of the wanted length with the distance from the rim
constexpr int most_passes = 40;
constexpr double few = 0.01;  // too long edges per own vertex that are not worth another pass
constexpr int sweeps_per_pass = 2;

struct LongEdge {
  double excess;  // length over the wanted length
  Index a, b;     // the ends of the edge when it was found
  NetEdge edge;
};

class Refinement {
 public:
  Refinement(Patch& patch, const RefineOptions& options) : p_(patch), options_(options) {
    for (Index v = p_.own_from; v < p_.size(); ++v) {
      p_.wanted[v] = std::min(p_.wanted[v], options.coarsening * p_.spacing[v]);
    }
  }

  bool run() {
    for (int pass = 0; pass < most_passes && split_long_edges(); ++pass) {
      flip_to_delaunay(p_);
      even_out(p_, sweeps_per_pass);
    }
    return !full_;
  }

 private:
  double length(Index a, Index b) const { return (p_.X.row(a) - p_.X.row(b)).norm(); }
  double wanted(Index a, Index b) const { return (p_.wanted[a] + p_.wanted[b]) / 2; }
  bool is_taken(Index a, Index b) const { return b < p_.own_from && p_.taken.contains(a, b); }

  std::vector<LongEdge> long_edges() const {
    std::vector<LongEdge> edges;
    for (Index t = 0; t < p_.net.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const NetEdge e{t, i};
        const Index a = p_.net.start(e), b = p_.net.end(e);
        if (a > b || p_.net.other_side(e).triangle < 0) {
          continue;  // listed from its other side, or on the rim
        }
        const double excess = length(a, b) / wanted(a, b);
        if (excess > too_long || is_taken(a, b)) {
          edges.push_back({excess, a, b, e});
        }
      }
    }
    std::sort(edges.begin(), edges.end(), [](const LongEdge& x, const LongEdge& y) {
      return std::tuple(-x.excess, x.a, x.b) < std::tuple(-y.excess, y.a, y.b);
    });
    return edges;
  }

  void update_normals() {
    // Not resized in place: if memory runs out while Eigen resizes a matrix, it is freed twice.
    Points normals = Points::Zero(p_.size(), 3);
    const auto add = [&](Index a, Index b, Index c) {
      const Vec3 N = double_area_vector(p_.X.row(a), p_.X.row(b), p_.X.row(c));
      for (const Index v : {a, b, c}) {
        normals.row(v) += N;
      }
    };
    for (const auto x : p_.surroundings.rowwise()) {
      add(x[0], x[1], x[2]);
    }
    for (Index t = 0; t < p_.net.size(); ++t) {
      add(p_.net[t][0], p_.net[t][1], p_.net[t][2]);
    }
    normals.rowwise().normalize();
    normal_.swap(normals);
  }

  /// The middle of the edge, or with `curved` of the cubic curve from a to b that is perpendicular
  /// to the vertex normals at both ends.
  Vec3 middle(Index a, Index b) const {
    const Vec3 xa = p_.X.row(a), xb = p_.X.row(b), chord = xb - xa;
    if (!options_.curved) {
      return (xa + xb) / 2;
    }
    const Vec3 na = normal_.row(a), nb = normal_.row(b);
    return (xa + xb) / 2 + (chord.dot(nb) * nb - chord.dot(na) * na) / 8;
  }

  /// Makes one pass over the edges that are too long at present. Returns whether another pass is
  /// needed.
  bool split_long_edges() {
    const std::vector<LongEdge> edges = long_edges();
    const bool all_may_stay = std::none_of(
        edges.begin(), edges.end(), [this](const LongEdge& e) { return is_taken(e.a, e.b); });
    if (all_may_stay && static_cast<double>(edges.size()) <= few * p_.own_size()) {
      return false;
    }
    const Index before = p_.size();
    std::vector<Vec3> added;
    if (options_.curved) {
      update_normals();
    }
    for (const auto& [excess, a, b, e] : edges) {
      // An earlier split may have changed the triangle of this edge; the next pass finds the edge
      // again.
      if (p_.net.start(e) != a || p_.net.end(e) != b) {
        continue;
      }
      const auto v = static_cast<Index>(before + static_cast<Index>(added.size()));
      if (v - p_.own_from >= options_.most_vertices) {
        full_ = true;
        break;
      }
      p_.net.split(e, v);
      added.push_back(middle(a, b));
      p_.spacing.push_back(p_.inner_spacing > 0 ? p_.inner_spacing
                                                : (p_.spacing[a] + p_.spacing[b]) / 2);
      p_.wanted.push_back(std::min(options_.coarsening * p_.spacing.back(),
                                   wanted(a, b) + grading * length(a, b) / 2));
      p_.free.push_back(1);
    }
    p_.X.conservativeResize(before + static_cast<Index>(added.size()), 3);
    for (std::size_t i = 0; i < added.size(); ++i) {
      p_.X.row(before + static_cast<Index>(i)) = added[i];
    }
    return !added.empty() && !full_;
  }

  Patch& p_;
  const RefineOptions& options_;
  Points normal_;
  bool full_ = false;
};

}  // namespace

bool refine(Patch& patch, const RefineOptions& options) {
  return Refinement(patch, options).run();
}

Index count_long_edges(const Patch& patch) {
  Index count = 0;
  for (Index t = 0; t < patch.net.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Index a = patch.net.start({t, i}), b = patch.net.end({t, i});
      const double wanted = (patch.spacing[a] + patch.spacing[b]) / 2;
      const bool is_long = (patch.X.row(a) - patch.X.row(b)).norm() > too_long * wanted;
      count += a < b && is_long && patch.net.other_side({t, i}).triangle >= 0 ? 1 : 0;
    }
  }
  return count;
}

void split_taken_edges(Patch& patch) {
  const double endless = std::numeric_limits<double>::infinity();
  std::fill(patch.wanted.begin(), patch.wanted.end(), endless);
  refine(patch, {.coarsening = endless, .most_vertices = std::numeric_limits<Index>::max()});
  patch.wanted = patch.spacing;
}

void relax(Patch& patch, Index first) {
  const Index n = patch.size();
  Points sum = Points::Zero(n, 3), normal = Points::Zero(n, 3);
  std::vector<double> count(n);
  for (Index t = 0; t < patch.net.size(); ++t) {
    const auto& x = patch.net[t];
    const Vec3 N = double_area_vector(patch.X.row(x[0]), patch.X.row(x[1]), patch.X.row(x[2]));
    for (int i = 0; i < 3; ++i) {
      normal.row(x[i]) += N;
      sum.row(x[i]) += patch.X.row(x[(i + 1) % 3]) + patch.X.row(x[(i + 2) % 3]);
      count[x[i]] += 2;
    }
  }
  for (Index v = first; v < n; ++v) {
    if (!patch.free[v] || count[v] == 0) {
      continue;
    }
    Vec3 step = (sum.row(v) / count[v] - patch.X.row(v)) / 2;
    const Vec3 N = normal.row(v);
    const double squared = N.squaredNorm();
    step -= squared > 0 ? Vec3(N * (N.dot(step) / squared)) : step;
    patch.X.row(v) += step;
  }
}

void even_out(Patch& patch, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    relax(patch, patch.own_from);
    flip_to_delaunay(patch);
  }
}

}  // namespace ibmfair
