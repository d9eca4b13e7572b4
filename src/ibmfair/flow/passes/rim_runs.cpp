#include "ibmfair/flow/passes/rim_runs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

/// A closed sequence of vertices, whose numbers are taken modulo its length.
class ClosedCurve {
 public:
  ClosedCurve(const Points& X, const std::vector<Index>& vertices) : X_(X), vertices_(vertices) {}

  Index size() const { return static_cast<Index>(vertices_.size()); }
  Vec3 point(Index i) const { return X_.row(vertices_[(i % size() + size()) % size()]); }

  /// The angle (radians) between the lines that fit vertex i and the `count` vertices before and
  /// after it, by least squares over their numbers.
  double turn(Index i, Index count) const {
    Vec3 before = Vec3::Zero(), after = Vec3::Zero();
    for (Index k = 0; k <= count; ++k) {
      const double weight = static_cast<double>(k) - static_cast<double>(count) / 2;
      before -= weight * point(i - k);
      after += weight * point(i + k);
    }
    return std::atan2(before.cross(after).norm(), before.dot(after));
  }

 private:
  const Points& X_;
  const std::vector<Index>& vertices_;
};

/// The numbers of the vertices of a curve that are corners, increasing.
std::vector<Index> corners_of(const ClosedCurve& curve) {
  const Index n = curve.size();
  const Index count = std::min(tuning.rims.fitted, n / 4);
  std::vector<double> sharpness(static_cast<std::size_t>(n), 0);
  for (Index i = 0; i < n; ++i) {
    const double turn = curve.turn(i, count);
    if (turn > tuning.rims.corner && turn > tuning.rims.lasting * curve.turn(i, 2 * count)) {
      sharpness[i] = turn;
    }
  }
  std::vector<Index> corners;
  for (Index i = 0; i < n; ++i) {
    bool is_sharpest = sharpness[i] > 0;
    for (Index k = 1; k <= count; ++k) {
      is_sharpest = is_sharpest && sharpness[i] >= sharpness[(i + k) % n] &&
                    sharpness[i] > sharpness[(i + n - k) % n];
    }
    if (is_sharpest) {
      corners.push_back(i);
    }
  }
  return corners;
}

/// Splits a closed curve at the flagged numbers.
void add_runs(const std::vector<Index>& vertices, const std::vector<std::uint8_t>& ends,
              std::vector<RimRun>& runs) {
  const auto n = static_cast<Index>(vertices.size());
  const auto first = static_cast<Index>(std::ranges::find(ends, 1) - ends.begin());
  if (first == n) {
    runs.push_back({vertices, true});
    return;
  }
  RimRun run{{vertices[first]}, false};
  for (Index k = 1; k <= n; ++k) {
    const Index i = (first + k) % n;
    run.vertices.push_back(vertices[i]);
    if (ends[i] != 0) {
      if (run.vertices.size() > 2) {
        runs.push_back(run);
      }
      run.vertices = {vertices[i]};
    }
  }
}

}  // namespace

std::vector<RimRun> rim_runs(const Points& X, const Topology& topology,
                             const std::vector<std::uint8_t>& fixed) {
  std::vector<RimRun> runs;
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    if (!loop.closed || loop.vertices.size() < least_rim_size) {
      continue;
    }
    std::vector<std::uint8_t> ends(loop.vertices.size());
    std::ranges::transform(loop.vertices, ends.begin(),
                           [&](Index v) { return fixed[v] != 0 ? 1 : 0; });
    for (const Index i : corners_of(ClosedCurve(X, loop.vertices))) {
      ends[i] = 1;
    }
    add_runs(loop.vertices, ends, runs);
  }
  return runs;
}

Eigen::SparseMatrix<double> negative_second_differences(Index n, bool closed) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2);
    for (const Index j : {i - 1, i + 1}) {
      if (closed || (j >= 0 && j < n)) {
        entries.emplace_back(i, (j + n) % n, -1);
      }
    }
  }
  Eigen::SparseMatrix<double> T(n, n);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

}  // namespace ibmfair
