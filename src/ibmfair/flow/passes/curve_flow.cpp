#include "ibmfair/flow/passes/curve_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/time_scale.h"

namespace ibmfair {
namespace {

/// Shorter edges (relative to the mean) count as so long: shorter ones make rows of S so large that
/// rounding errors would move the points beside them.
constexpr double shortest_edge = 1e-3;

/// Longer cut-offs (relative to the length of the polyline) count as so long: all ripples are gone
/// by then, and rounding errors grow with the time.
constexpr double longest_cutoff_closed = 2, longest_cutoff_open = 8;

void validate(const CurveFlowOptions& options, Eigen::Index points) {
  const auto& factor = options.cutoff_factor;
  if (!(options.cutoff > 0) || options.steps < 1 || options.twicing < 0) {
    throw BadOption("the flow of a curve needs a positive cut-off and at least one step");
  }
  if (factor.size() > 0 &&
      (factor.size() != points || !(factor.array() >= 0 && factor.array().isFinite()).all())) {
    throw BadOption("the cut-off factors of a curve are one non-negative number for each point");
  }
}

/// A polyline whose mean edge length is 1, and the linear system of a time step.
class Polyline {
 public:
  Polyline(const Points& X, CurveEnds ends, const CurveFlowOptions& options)
      : count_(X.rows()), closed_(ends == CurveEnds::closed) {
    measure(X);
    if (scale_ > 0) {
      number_free_points(ends, options.cutoff_factor);
      assemble(options);
    }
  }

  /// The points that can move.
  const std::vector<Eigen::Index>& free() const { return free_; }

  /// The move of all points by the flow from `Y`, zero where points are fixed.
  Points flow(const Points& Y, int steps) const {
    Points moved = Y;
    for (int step = 0; step < steps; ++step) {
      const Eigen::MatrixXd force = h_ * (S_ * moved);
      const Eigen::MatrixXd move = factor_.solve(-force(free_, Eigen::all));
      moved(free_, Eigen::all) += move;
    }
    return moved - Y;
  }

  /// The part of `Y` that is no ellipse: without its mean and its first Fourier mode over s. All of
  /// `Y` if the polyline is open.
  Points without_ellipse(const Points& Y) const {
    if (!closed_) {
      return Y;
    }
    Eigen::MatrixX3d modes(count_, 3);
    const double turn = 2 * std::numbers::pi / (arc_[count_ - 1] + length_[count_ - 1]);
    for (Eigen::Index i = 0; i < count_; ++i) {
      modes.row(i) << 1, std::cos(turn * arc_[i]), std::sin(turn * arc_[i]);
    }
    const Eigen::MatrixX3d weighted = mass_.asDiagonal() * modes;
    const Eigen::Matrix3d amplitudes =
        (weighted.transpose() * modes).ldlt().solve(weighted.transpose() * Y);
    return Y - modes * amplitudes;
  }

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  Eigen::Index next(Eigen::Index i) const { return i + 1 < count_ ? i + 1 : 0; }

  void measure(const Points& X) {
    const Eigen::Index edges = closed_ ? count_ : count_ - 1;
    length_.resize(std::max<Eigen::Index>(edges, 0));
    for (Eigen::Index i = 0; i < edges; ++i) {
      length_[i] = (X.row(next(i)) - X.row(i)).stableNorm();
    }
    scale_ = edges > 1 && std::isfinite(length_.sum()) ? length_.mean() : 0;
    if (!(scale_ > 0)) {
      return;
    }
    length_ = (length_ / scale_).cwiseMax(shortest_edge);
    mass_ = Eigen::VectorXd::Zero(count_);
    arc_ = Eigen::VectorXd::Zero(count_);
    for (Eigen::Index i = 0; i < edges; ++i) {
      mass_[i] += length_[i] / 2;
      mass_[next(i)] += length_[i] / 2;
      if (i + 1 < count_) {
        arc_[i + 1] = arc_[i] + length_[i];
      }
    }
  }

  void number_free_points(CurveEnds ends, const Eigen::VectorXd& factor) {
    const Eigen::Index stay = ends == CurveEnds::closed ? 0 : ends == CurveEnds::natural ? 1 : 2;
    for (Eigen::Index i = stay; i + stay < count_; ++i) {
      if (factor.size() == 0 || factor[i] > 0) {
        free_.push_back(i);
      }
    }
  }

  void assemble(const CurveFlowOptions& options) {
    // Rows of L at the ends of an open polyline are left out: no force turns it about its ends.
    std::vector<Eigen::Triplet<double>> entries;
    const auto add_edge = [&](Eigen::Index row, Eigen::Index i, Eigen::Index j, double length) {
      entries.emplace_back(row, i, 1 / length);
      entries.emplace_back(row, j, -1 / length);
    };
    for (Eigen::Index i = closed_ ? 0 : 1; i < (closed_ ? count_ : count_ - 1); ++i) {
      const Eigen::Index before = i > 0 ? i - 1 : count_ - 1;
      add_edge(i, i, before, length_[before]);
      add_edge(i, i, next(i), length_[i]);
    }
    Sparse L(count_, count_);
    L.setFromTriplets(entries.begin(), entries.end());
    S_ = Sparse(L.transpose()) * Sparse(mass_.cwiseInverse().asDiagonal() * L);
    const double longest = (closed_ ? longest_cutoff_closed : longest_cutoff_open) * length_.sum();
    h_ = time_for_cutoff(std::min(options.cutoff / scale_, longest)) / options.steps;
    factor_.compute(system_of_free_points(options.cutoff_factor));
  }

  Sparse system_of_free_points(const Eigen::VectorXd& factor) const {
    Eigen::VectorXi place = Eigen::VectorXi::Constant(count_, -1);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      place[free_[i]] = static_cast<int>(i);
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const Eigen::Index i : free_) {
      const double D = mass_[i] / (factor.size() > 0 ? std::pow(factor[i], 4) : 1);
      entries.emplace_back(place[i], place[i], D);
      for (Sparse::InnerIterator entry(S_, i); entry; ++entry) {
        if (place[entry.row()] >= 0) {
          entries.emplace_back(place[entry.row()], place[i], h_ * entry.value());
        }
      }
    }
    Sparse J(static_cast<Eigen::Index>(free_.size()), static_cast<Eigen::Index>(free_.size()));
    J.setFromTriplets(entries.begin(), entries.end());
    return J;
  }

  Eigen::Index count_;
  bool closed_;
  double scale_ = 0;              // the mean edge length of the points
  Eigen::VectorXd length_, arc_;  // of each edge, and up to each point
  Eigen::VectorXd mass_;          // of each point
  std::vector<Eigen::Index> free_;
  Sparse S_;
  double h_ = 0;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

}  // namespace

Points curve_flow(const Points& X, CurveEnds ends, const CurveFlowOptions& options) {
  validate(options, X.rows());
  const Polyline line(X, ends, options);
  if (line.free().empty()) {
    return X;
  }
  const Points start = line.without_ellipse(X.rowwise() - X.row(0));
  Points move = line.flow(start, options.steps);
  for (int pass = 0; pass < options.twicing; ++pass) {
    const Points removed = -move;
    move += removed + line.flow(removed, options.steps);
  }
  Points result = X;
  result(line.free(), Eigen::all) += move(line.free(), Eigen::all);
  return result;
}

}  // namespace ibmfair
