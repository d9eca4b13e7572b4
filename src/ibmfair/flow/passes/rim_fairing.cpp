#include "ibmfair/flow/passes/rim_fairing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/SparseCholesky>

#include "ibmfair/flow/passes/rim_runs.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The smoother of one run, F = 1 - (1 - (1 + h T^2)^-s)^(twicing + 1), on its inner vertices. T x
/// are the negative second differences, s is the number of steps. The ends of an open run are zero.
/// T has the eigenvalues 2 - 2 cos(angle) with evenly spaced angles.
class CurveSmoother {
 public:
  /// `cutoff`: in edges of the run.
  CurveSmoother(Index inner, bool closed, double cutoff, int twicing)
      : twicing_(twicing), step_(std::pow(cutoff / (2 * std::numbers::pi), 4) / steps) {
    const Sparse T = negative_second_differences(inner, closed);
    Sparse one(inner, inner);
    one.setIdentity();
    factor_.compute(Sparse(one + step_ * Sparse(T * T)));
    const double angle = std::numbers::pi / (closed ? inner : inner + 1);
    for (Index j = 0; j < inner; ++j) {
      const double eigenvalue = 2 - 2 * std::cos((closed ? 2 * j : j + 1) * angle);
      const double left = std::pow(1 + step_ * eigenvalue * eigenvalue, -steps);
      const double taken = std::pow(1 - left, twicing_ + 1);
      removed_ += taken / static_cast<double>(inner);
      removed_variance_ += taken * taken / static_cast<double>(inner);
    }
  }

  double removed() const { return removed_; }                    ///< tr(1 - F) / n
  double removed_variance() const { return removed_variance_; }  ///< tr((1 - F)^2) / n

  /// (1 - F) x, one row per inner vertex: what the smoother removes. Of an open run, x is measured
  /// from the chord between its ends, which has no second differences.
  Points removed_from(const Points& x) const {
    Points left = x;
    for (int pass = 0; pass <= twicing_; ++pass) {
      Points smooth = left;
      for (int k = 0; k < steps; ++k) {
        smooth = factor_.solve(smooth).eval();
      }
      left -= smooth;
    }
    return left;
  }

 private:
  static constexpr int steps = tuning.rims.steps;
  int twicing_;
  double step_;  // h, in units of edge^4
  Eigen::SimplicialLDLT<Sparse> factor_;
  double removed_ = 0, removed_variance_ = 0;
};

/// Unit normals of the surface near the rims, averaged over several rings, so that noise hardly
/// turns them: #V x 3, zero elsewhere.
Points mean_normals(const Points& X, const Topology& topology, const std::vector<RimRun>& runs) {
  std::vector<std::uint8_t> near(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const RimRun& run : runs) {
    for (const Index v : run.vertices) {
      near[v] = 1;
    }
  }
  for (int k = 0; k < tuning.rims.normal_rings; ++k) {
    near = grow_one_ring(topology, near);
  }
  Points normals = Points::Zero(X.rows(), 3);
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (near[v] != 0) {
      normals.row(v) = double_area_vector_at(v, X, topology);
    }
  }
  for (int k = 0; k < tuning.rims.normal_rings; ++k) {
    Points sums = Points::Zero(X.rows(), 3);
    for (Index v = 0; v < topology.vertex_count; ++v) {
      for (const Index t : near[v] != 0 ? topology.stars[v] : std::span<const Index>()) {
        for (const Index w : topology.F.row(t)) {
          sums.row(v) += normals.row(w);
        }
      }
    }
    for (Index v = 0; v < topology.vertex_count; ++v) {
      normals.row(v) = sums.row(v).stableNormalized();
    }
  }
  return normals;
}

/// The variance of the noise of a run along the normals, and in each direction within the surface.
/// Neither is more than what the shortest cut-off finds: noise along the normals only, as that of
/// depth cameras, leaves the distances along the rim even, and explains no zigzag.
struct RimNoise {
  double normal, within;
};

/// Fairs the runs one after another.
class RimFairer {
 public:
  RimFairer(const Points& X, const Topology& topology, const RimFairing& options,
            const std::vector<RimRun>& runs)
      : X_(X), options_(options) {
    if (options_.noise > 0) {
      normals_ = mean_normals(X, topology, runs);
    }
  }

  /// Writes the moves of a run's vertices (#V x 3).
  void add_moves(const RimRun& run, Points& moves) const {
    const Points x = X_(run.vertices, Eigen::all);
    const Points move = best_moves(run, x);
    const Index first = run.closed ? 0 : 1;
    for (Index i = 0; i < move.rows(); ++i) {
      const double far = move.row(i).norm();
      const double share = far > options_.max_move ? options_.max_move / far : 1;
      moves.row(run.vertices[first + i]) = share * move.row(i);
    }
  }

 private:
  /// The moves of a run's inner vertices; `x`: all its vertices. If the noise is known, the cut-off
  /// is that with the least estimated error, from the given one upward.
  Points best_moves(const RimRun& run, const Points& x) const {
    const auto n = static_cast<Index>(run.vertices.size());
    double length = run.closed ? (x.row(0) - x.row(n - 1)).norm() : 0;
    for (Index i = 1; i < n; ++i) {
      length += (x.row(i) - x.row(i - 1)).norm();
    }
    const double edges = run.closed ? n : n - 1, longest = edges / tuning.rims.least_waves;
    const Index inner = run.closed ? n : n - 2;
    Points best = Points::Zero(inner, 3);
    double cutoff = std::min(options_.cutoff * edges / length, longest), least = 0;
    std::optional<RimNoise> noise;
    for (int i = 0; length > 0 && i < tuning.rims.tried && cutoff <= longest; ++i) {
      const CurveSmoother smoother(inner, run.closed, cutoff, options_.twicing);
      Points move = -smoother.removed_from(from_chord(run, x));
      if (!(options_.noise > 0)) {
        return move;
      }
      const double error = keep_outline(run, x, smoother, noise, move);
      if (error < least) {
        least = error;
        best = move;
      }
      cutoff *= tuning.rims.longer;
    }
    return best;
  }

  /// The inner vertices of a run, those of an open run measured from the chord of its ends.
  static Points from_chord(const RimRun& run, const Points& x) {
    if (run.closed) {
      return x;
    }
    const Eigen::Index last = x.rows() - 1;
    Points offset = x.middleRows(1, last - 1);
    for (Eigen::Index i = 1; i < last; ++i) {
      const double along = static_cast<double>(i) / static_cast<double>(last);
      offset.row(i - 1) -= (1 - along) * x.row(0) + along * x.row(last);
    }
    return offset;
  }

  /// Reduces the parts of the moves within the surface to the shares that noise explains: all of it
  /// for an outline that is no rougher than the noise, so that a straight one stays straight.
  /// Returns the change of the expected squared error along the normals, as Stein estimates it
  /// (flow/settings/cutoff_trials.h). `noise`: found if it is not known yet.
  double keep_outline(const RimRun& run, const Points& x, const CurveSmoother& smoother,
                      std::optional<RimNoise>& noise, Points& move) const {
    const Index n = static_cast<Index>(run.vertices.size()),
                inner = static_cast<Index>(move.rows()), first = run.closed ? 0 : 1;
    Points smooth = x;
    smooth.middleRows(first, inner) += move;
    Points parts(inner, 3), along(inner, 3), across(inner, 3);  // parts: normal, along, across
    for (Index i = 0; i < inner; ++i) {
      const Index k = first + i;
      const Vec3 normal = normals_.row(run.vertices[k]);
      const Vec3 chord = smooth.row((k + 1) % n) - smooth.row((k + n - 1) % n);
      const Vec3 tangent = (chord - chord.dot(normal) * normal).stableNormalized();
      along.row(i) = tangent;
      across.row(i) = tangent.cross(normal);
      parts.row(i) << move.row(i).dot(normal), move.row(i).dot(along.row(i)),
          move.row(i).dot(across.row(i));
    }
    const Eigen::Array3d squared =
        parts.colwise().squaredNorm().transpose().array() / static_cast<double>(inner);
    const double given = options_.noise * options_.noise;
    if (!noise) {
      const Eigen::Array3d found = squared / smoother.removed_variance();
      noise = {std::min(given, found[0]), std::min(given, found.minCoeff())};
    }
    const double explained = noise->within * smoother.removed();
    Eigen::Array3d share = (squared > given * smoother.removed()).select(explained / squared, 1.0);
    share[0] = 1;
    move -= (1 - share[1]) * parts.col(1).asDiagonal() * along +
            (1 - share[2]) * parts.col(2).asDiagonal() * across;
    return squared[0] - 2 * noise->normal * smoother.removed();
  }

  const Points& X_;
  const RimFairing& options_;
  Points normals_;  // #V x 3
};

}  // namespace

std::vector<std::uint8_t> fair_rims(Points& X, const Topology& topology,
                                    const std::vector<std::uint8_t>& fixed,
                                    const RimFairing& options) {
  const std::vector<RimRun> runs = rim_runs(X, topology, fixed);
  if (runs.empty()) {
    return fixed;
  }
  const RimFairer fairer(X, topology, options, runs);
  Points moves = Points::Zero(X.rows(), 3);
  std::vector<std::uint8_t> held = fixed;
  for (const RimRun& run : runs) {
    fairer.add_moves(run, moves);
    const std::size_t ends = run.closed ? 0 : 1;
    for (std::size_t i = ends; i + ends < run.vertices.size(); ++i) {
      held[run.vertices[i]] = 1;
    }
  }
  for (const Index v : move_without_folds(moves, topology, X)) {
    held[v] = fixed[v];
  }
  return held;
}

}  // namespace ibmfair
