#include "ibmfair/flow/passes/outliers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/select.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

class OutlierSearch {
 public:
  OutlierSearch(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed)
      : topology_(topology),
        fixed_(fixed),
        rings_(vertex_rings(topology)),
        X_(X),
        limit_(least_ratio()) {}

  Outliers find() {
    std::vector<std::uint8_t> found(static_cast<std::size_t>(X_.rows()), 0);
    for (int pass = 0; pass < tuning.outliers.passes; ++pass) {
      const std::vector<Index> moved = move_outliers_among(far_from_their_neighbours());
      if (moved.empty()) {
        break;
      }
      for (const Index v : moved) {
        found[v] = 1;
      }
    }
    Outliers outliers;
    outliers.vertices = indices_where(X_.rows(), [&](Index v) { return found[v] != 0; });
    for (int sweep = 0; sweep < tuning.outliers.sweeps; ++sweep) {
      for (const Index v : outliers.vertices) {
        minimise_energy_at(v);
      }
    }
    outliers.positions = X_(outliers.vertices, Eigen::all);
    return outliers;
  }

 private:
  double valence(Index v) const { return static_cast<double>(rings_[v].size()); }

  Vec3 mean_of_neighbours(Index v) const {
    Vec3 sum = Vec3::Zero();
    for (const Index q : rings_[v]) {
      sum += X_.row(q);
    }
    return sum / valence(v);
  }

  double distance_from_mean(Index v) const {
    return (X_.row(v).transpose() - mean_of_neighbours(v)).norm();
  }

  bool may_move(Index v) const {
    return !fixed_[v] && is_oriented_interior(topology_, v) &&
           rings_[v].size() <= tuning.outliers.most_neighbours;
  }

  std::vector<Index> far_from_their_neighbours() const {
    std::vector<std::uint8_t> far(static_cast<std::size_t>(X_.rows()));
    parallel_for(X_.rows(), [&](std::int64_t i) {
      const auto v = static_cast<Index>(i);
      far[v] = may_move(v) && distance_ratio(v) > limit_;
    });
    return in_enclosed_groups(far);
  }

  /// The flagged vertices whose groups (those connected by edges) have more neighbours than
  /// members: a whole tetrahedron has none, and would shrink to a point.
  std::vector<Index> in_enclosed_groups(const std::vector<std::uint8_t>& flags) const {
    std::vector<Index> members = indices_where(X_.rows(), [&](Index v) { return flags[v] != 0; });
    UnionFind groups(static_cast<Index>(X_.rows()));
    for (const Index v : members) {
      for (const Index q : rings_[v]) {
        if (flags[q]) {
          groups.unite(v, q);
        }
      }
    }
    std::vector<std::pair<Index, Index>> beside;  // group and neighbour
    std::vector<Index> surplus(flags.size(), 0);  // neighbours less members, at the representative
    for (const Index v : members) {
      const Index group = groups.find(v);
      --surplus[group];
      for (const Index q : rings_[v]) {
        if (!flags[q]) {
          beside.emplace_back(group, q);
        }
      }
    }
    std::ranges::sort(beside);
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const auto& [group, neighbour] : beside) {
      ++surplus[group];
    }
    std::erase_if(members, [&](Index v) { return surplus[groups.find(v)] <= 0; });
    return members;
  }

  /// Moves those of the vertices that are off the surface onto it, and returns them. The surface is
  /// the one that all other vertices form: outliers side by side hide each other.
  std::vector<Index> move_outliers_among(const std::vector<Index>& vertices) {
    const Points before = X_(vertices, Eigen::all);
    for (int sweep = 0; sweep < tuning.outliers.sweeps; ++sweep) {
      for (const Index v : vertices) {
        X_.row(v) = mean_of_neighbours(v);
      }
    }
    std::vector<std::uint8_t> off(vertices.size());
    parallel_for(std::ssize(vertices), [&](std::int64_t i) {
      const double distance = (before.row(i) - X_.row(vertices[i])).norm();
      off[i] = distance > tuning.outliers.beside_surface * unevenness_around(vertices[i]);
    });
    std::vector<Index> moved;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (off[i]) {
        moved.push_back(vertices[i]);
      } else {
        X_.row(vertices[i]) = before.row(static_cast<Index>(i));
      }
    }
    return moved;
  }

  /// The distance of a vertex from the mean of its neighbours, over their mean distance from it.
  double distance_ratio(Index v) const {
    const Vec3 mean = mean_of_neighbours(v);
    double radius = 0;
    for (const Index q : rings_[v]) {
      radius += (X_.row(q).transpose() - mean).norm() / valence(v);
    }
    return radius > 0 ? (X_.row(v).transpose() - mean).norm() / radius : 0;
  }

  /// The least ratio of outliers.
  double least_ratio() const {
    const std::vector<Index> free = indices_where(X_.rows(), [&](Index v) { return may_move(v); });
    if (free.empty()) {
      return 0;
    }
    std::vector<double> ratios(free.size());
    parallel_for(std::ssize(free), [&](std::int64_t i) { ratios[i] = distance_ratio(free[i]); });
    return std::max(tuning.outliers.beside_neighbours,
                    tuning.outliers.beside_mesh * median(ratios));
  }

  /// The lower median distance of the neighbours from the means of theirs: with six neighbours, an
  /// outlier among them spoils the distances of three.
  double unevenness_around(Index v) const {
    std::array<double, OutlierTuning::most_neighbours> distances{};
    const std::span<const Index> ring = rings_[v];
    std::ranges::transform(ring, distances.begin(), [&](Index q) { return distance_from_mean(q); });
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((ring.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.begin() + std::ssize(ring));
    return *middle;
  }

  void minimise_energy_at(Index v) {
    Vec3 sum = mean_of_neighbours(v);
    double weight = 1;
    for (const Index q : rings_[v]) {
      if (is_oriented_interior(topology_, q)) {
        const double share = 1 / valence(q);
        const Vec3 mean_of_others = mean_of_neighbours(q) - share * X_.row(v).transpose();
        sum -= share * (mean_of_others - X_.row(q).transpose());
        weight += share * share;
      }
    }
    X_.row(v) = sum / weight;
  }

  const Topology& topology_;
  const std::vector<std::uint8_t>& fixed_;
  const CompressedRows rings_;
  Points X_;  // with the outliers found so far moved
  const double limit_;
};

}  // namespace

void Outliers::move_in(Points& X) const {
  X(vertices, Eigen::all) = positions;
}

Outliers find_outliers(const Points& X, const Topology& topology,
                       const std::vector<std::uint8_t>& fixed) {
  return OutlierSearch(X, topology, fixed).find();
}

}  // namespace ibmfair
