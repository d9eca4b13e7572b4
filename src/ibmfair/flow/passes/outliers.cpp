#include "ibmfair/flow/passes/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/passes/rim_extrapolation.h"
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
        rims_(rim_extrapolation(topology)),
        rim_columns_(rims_),
        given_(X),
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
    outliers.vertices =
        without_sound_rims(indices_where(X_.rows(), [&](Index v) { return found[v] != 0; }));
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

  bool is_inside(Index v) const { return is_oriented_interior(topology_, v); }
  bool is_predicted_rim(Index v) const { return rims_.innerVector(v).nonZeros() > 0; }

  /// Where the vertices around v predict it.
  Vec3 prediction(Index v) const {
    Vec3 sum = Vec3::Zero();
    if (is_predicted_rim(v)) {
      for (RimRow entry(rims_, v); entry; ++entry) {
        sum += entry.value() * X_.row(entry.col());
      }
      return sum;
    }
    for (const Index q : rings_[v]) {
      sum += X_.row(q);
    }
    return sum / valence(v);
  }

  Vec3 offset(Index v) const { return X_.row(v).transpose() - prediction(v); }

  /// How far such an offset is off the surface; any outline of a rim within the surface is allowed.
  double off_surface(Index v, const Vec3& offset) const {
    return is_predicted_rim(v) ? std::abs(offset.dot(normal_beside(X_, topology_, v)))
                               : offset.norm();
  }

  bool may_move(Index v) const {
    return !fixed_[v] && (is_inside(v) || is_predicted_rim(v)) &&
           rings_[v].size() >= tuning.outliers.least_neighbours &&
           rings_[v].size() <= tuning.outliers.most_neighbours;
  }

  std::vector<Index> far_from_their_neighbours() const {
    std::vector<std::uint8_t> far(static_cast<std::size_t>(X_.rows()));
    parallel_for(X_.rows(), [&](std::int64_t i) {
      const auto v = static_cast<Index>(i);
      far[v] = may_move(v) && distance_ratio(v, X_) > limit_;
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
        X_.row(v) = prediction(v);
      }
    }
    std::vector<std::uint8_t> off(vertices.size());
    parallel_for(std::ssize(vertices),
                 [&](std::int64_t i) { off[i] = is_off_surface(vertices[i]); });
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

  /// Moves those back that only seemed to be off the surface beside outliers that were found later:
  /// predictions of rims depend on vertices two rings away.
  std::vector<Index> without_sound_rims(std::vector<Index> vertices) {
    std::erase_if(vertices, [&](Index v) {
      const bool sound = is_predicted_rim(v) &&
                         (distance_ratio(v, given_) <= tuning.outliers.sound_at_rims * limit_ ||
                          !is_off_surface(v));
      if (sound) {
        X_.row(v) = given_.row(v);
      }
      return sound;
    });
    return vertices;
  }

  /// Whether a vertex was given far off the surface that the vertices around it form now.
  bool is_off_surface(Index v) const {
    const double distance = off_surface(v, given_.row(v).transpose() - prediction(v));
    return distance > tuning.outliers.beside_surface * unevenness_around(v);
  }

  /// The distance of a vertex at X from its prediction, over its neighbours' mean distance from
  /// that.
  double distance_ratio(Index v, const Points& X) const {
    const Vec3 predicted = prediction(v);
    double radius = 0;
    for (const Index q : rings_[v]) {
      radius += (X_.row(q).transpose() - predicted).norm() / valence(v);
    }
    return radius > 0 ? off_surface(v, X.row(v).transpose() - predicted) / radius : 0;
  }

  /// The least ratio of outliers.
  double least_ratio() const {
    const std::vector<Index> free = indices_where(X_.rows(), [&](Index v) { return may_move(v); });
    if (free.empty()) {
      return 0;
    }
    std::vector<double> ratios(free.size());
    parallel_for(std::ssize(free),
                 [&](std::int64_t i) { ratios[i] = distance_ratio(free[i], X_); });
    return std::max(tuning.outliers.beside_neighbours,
                    tuning.outliers.beside_mesh * median(ratios));
  }

  /// The lower median distance of the neighbours from their predictions: with six neighbours, an
  /// outlier among them spoils the distances of three.
  double unevenness_around(Index v) const {
    std::array<double, OutlierTuning::most_neighbours> distances{};
    const std::span<const Index> ring = rings_[v];
    std::ranges::transform(ring, distances.begin(),
                           [&](Index q) { return off_surface(q, offset(q)); });
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((ring.size() - 1) / 2);
    std::nth_element(distances.begin(), middle, distances.begin() + std::ssize(ring));
    return *middle;
  }

  /// Of the energy sum |x - prediction|^2, over the interior and the predicted rims.
  void minimise_energy_at(Index v) {
    Vec3 half_gradient = Vec3::Zero();
    double half_curvature = 0;
    const auto add = [&](Index q, double derivative) {
      half_gradient += derivative * (X_.row(q).transpose() - prediction(q));
      half_curvature += derivative * derivative;
    };
    add(v, 1);
    for (const Index q : rings_[v]) {
      if (is_inside(q)) {
        add(q, -1 / valence(q));
      }
    }
    for (RimColumn entry(rim_columns_, v); entry; ++entry) {
      add(static_cast<Index>(entry.row()), -entry.value());
    }
    X_.row(v) -= half_gradient / half_curvature;
  }

  using Rims = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using RimColumns = Eigen::SparseMatrix<double>;
  using RimRow = Rims::InnerIterator;
  using RimColumn = RimColumns::InnerIterator;

  const Topology& topology_;
  const std::vector<std::uint8_t>& fixed_;
  const CompressedRows rings_;
  const Rims rims_;
  const RimColumns rim_columns_;
  const Points& given_;
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
