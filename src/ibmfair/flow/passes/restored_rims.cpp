#include "ibmfair/flow/passes/restored_rims.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <deque>
#include <numbers>
#include <utility>

#include <Eigen/SparseCholesky>

#include "ibmfair/flow/passes/rim_runs.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A vertex near a rim, and the number of the vertex of the rim that it is beside.
struct NearRim {
  Index vertex, beside;
};

/// Goes from the vertices of a rim through the rings of vertices beside it. Each vertex belongs to
/// the ring of one rim.
class RingWalk {
 public:
  /// `taken`: #V flags of the vertices that belong to a ring; is updated.
  RingWalk(const BoundaryLoop& loop, const Topology& topology, std::vector<std::uint8_t>& taken)
      : topology_(topology), taken_(taken), size_(static_cast<Index>(loop.vertices.size())) {
    for (Index i = 0; i < size_; ++i) {
      ring_.push_back({loop.vertices[i], i});
      taken_[loop.vertices[i]] = 1;
    }
  }

  const std::vector<NearRim>& ring() const { return ring_; }

  /// Goes on to the next ring. Places along the rim are directions in a circle, whose sum tells
  /// where a vertex is.
  void advance() {
    std::vector<std::pair<Index, std::complex<double>>> directions;
    for (const NearRim& near : ring_) {
      const auto direction = std::polar(1.0, turn * near.beside / size_);
      for (const Index t : topology_.stars[near.vertex]) {
        for (const Index v : topology_.F.row(t)) {
          if (!taken_[v]) {
            directions.emplace_back(v, direction);
          }
        }
      }
    }
    std::ranges::stable_sort(directions, {}, [](const auto& entry) { return entry.first; });
    ring_.clear();
    for (std::size_t i = 0; i < directions.size();) {
      const Index v = directions[i].first;
      std::complex<double> sum = 0;
      for (; i < directions.size() && directions[i].first == v; ++i) {
        sum += directions[i].second;
      }
      const auto place = static_cast<Index>(std::lround(std::arg(sum) / turn * size_));
      ring_.push_back({v, (place + size_) % size_});
      taken_[v] = 1;
    }
  }

 private:
  const Topology& topology_;
  std::vector<std::uint8_t>& taken_;
  Index size_;
  std::vector<NearRim> ring_;
};

/// Residuals along a rim of n vertices: how many there are beside each of them, and their sums.
struct Residuals {
  Eigen::VectorXd count, sum;
};

/// Smooths residuals along a rim: f minimises sum_i count_i (f_i - mean_i)^2 + h |T f|^2, where T f
/// are the negative second differences, with the eigenvalues 2 - 2 cos(2 pi j / n).
class RimSpline {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  explicit RimSpline(Index n) : n_(n) {
    const Sparse T = negative_second_differences(n, true);
    penalty_ = T * T;
    factor_.analyzePattern(penalty_);
  }

  /// The part that noise of this variance does not explain, or zero. Wavelengths are tried from
  /// `shortest` (in edges of the rim) to those that leave a constant.
  Eigen::VectorXd lasting_part(const Residuals& residuals, double shortest, double variance) {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(n_);
    double least = -tuning.rims.clear_gain * variance;
    for (double wave = shortest; wave < tuning.rims.constant * n_; wave *= 2) {
      const double h = std::pow(wave / turn, 4);
      const Eigen::VectorXd fit = fitted(residuals, h);
      const double squares = fit.cwiseAbs2().dot(residuals.count), kept = trace(residuals, h);
      const double change = squares - 2 * fit.dot(residuals.sum) + 2 * variance * kept;
      if (change < least) {
        least = change;
        best = std::max(0.0, 1 - variance * (kept + 1) / squares) * fit;
      }
    }
    return best;
  }

 private:
  Eigen::VectorXd fitted(const Residuals& residuals, double h) {
    Sparse normal = h * penalty_;
    normal.diagonal() += residuals.count;
    factor_.factorize(normal);
    return factor_.solve(residuals.sum);
  }

  /// The trace of the smoother, as if the residuals were spread evenly.
  double trace(const Residuals& residuals, double h) const {
    const double density = residuals.count.mean();
    double sum = 0;
    for (Index j = 0; j < n_; ++j) {
      const double eigenvalue = 2 - 2 * std::cos(turn * j / n_);
      sum += density / (density + h * eigenvalue * eigenvalue);
    }
    return sum;
  }

  Index n_;
  Sparse penalty_;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

/// A rim, with the ring that comes next. What the flow takes fades away from the rim, so that the
/// first ring beside it with nothing to be given back is the last: chance would find some in one of
/// many rings.
class Rim {
 public:
  Rim(const BoundaryLoop& loop, const Topology& topology, std::vector<std::uint8_t>& taken)
      : size_(static_cast<Index>(loop.vertices.size())),
        walk_(loop, topology, taken),
        spline_(size_) {}

  /// Writes the moves (#V x 3) of the next ring from X toward `start`.
  void add_moves(const Points& start, const Points& X, const Topology& topology, double edges,
                 double variance, Points& moves) {
    Residuals residuals{Eigen::VectorXd::Zero(size_), Eigen::VectorXd::Zero(size_)};
    for (const auto& [v, i] : walk_.ring()) {
      moves.row(v) = double_area_vector_at(v, X, topology).stableNormalized();
      residuals.sum[i] += moves.row(v).dot(start.row(v) - X.row(v));
      ++residuals.count[i];
    }
    const Eigen::VectorXd lasting = spline_.lasting_part(residuals, edges, variance);
    for (const auto& [v, i] : walk_.ring()) {
      moves.row(v) *= lasting[i];
    }
    goes_on_ = is_rim_itself_ || !lasting.isZero(0);
    is_rim_itself_ = false;
    walk_.advance();
  }

  bool has_ring() const { return goes_on_ && !walk_.ring().empty(); }

 private:
  Index size_;
  RingWalk walk_;
  RimSpline spline_;
  bool is_rim_itself_ = true, goes_on_ = true;
};

}  // namespace

void restore_rims(const Points& start, const Topology& topology,
                  const std::vector<std::uint8_t>& fixed, double cutoff, double noise, Points& X) {
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(topology.vertex_count), 0);
  std::deque<Rim> rims;
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    if (loop.closed && loop.vertices.size() >= least_rim_size) {
      rims.emplace_back(loop, topology, taken);
    }
  }
  const double edges = cutoff / mean_edge_length(X, topology.E);
  Points moves = Points::Zero(X.rows(), 3);
  for (int ring = 0; ring <= edges; ++ring) {
    for (Rim& rim : rims) {
      if (rim.has_ring()) {
        rim.add_moves(start, X, topology, edges, noise * noise, moves);
      }
    }
  }
  for (Index v = 0; v < topology.vertex_count; ++v) {
    if (fixed[v]) {
      moves.row(v).setZero();
    }
  }
  move_without_folds(moves, topology, X);
}

}  // namespace ibmfair
