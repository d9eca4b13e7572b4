#include "ibmfair/page/decimate.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <meshoptimizer.h>

namespace ibmfair {
namespace {

constexpr float any_error = std::numeric_limits<float>::max();

std::vector<float> positions_about_centre(const Points& X) {
  const Eigen::RowVector3d centre = (X.colwise().minCoeff() + X.colwise().maxCoeff()) / 2;
  std::vector<float> positions(static_cast<std::size_t>(X.size()));
  Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      positions.data(), X.rows(), 3) = (X.rowwise() - centre).cast<float>();
  return positions;
}

/// Decimates by edge collapses, which keep the surface a manifold. meshopt_simplifySloppy takes a
/// seventeenth of the time but is seven times as far from the surface (a torus of 5.2 million
/// triangles reduced to 200 thousand: 7 s and 1.8e-4 of its size, against 0.4 s and 1.2e-3).
std::vector<unsigned> collapse_edges(const std::vector<float>& positions,
                                     const std::vector<unsigned>& corners, std::size_t target) {
  std::vector<unsigned> kept(corners.size());
  kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), positions.data(),
                               positions.size() / 3, 3 * sizeof(float), target, any_error,
                               meshopt_SimplifyLockBorder, nullptr));
  return kept;
}

std::vector<unsigned> merge_cells(const std::vector<float>& positions,
                                  const std::vector<unsigned>& corners, std::size_t target) {
  std::vector<unsigned> kept(corners.size());
  kept.resize(meshopt_simplifySloppy(kept.data(), corners.data(), corners.size(), positions.data(),
                                     positions.size() / 3, 3 * sizeof(float), target, any_error,
                                     nullptr));
  return kept;
}

}  // namespace

Triangles decimate(const Points& X, const Triangles& F, Index most) {
  if (F.rows() <= most) {
    return F;
  }
  const std::vector<float> positions = positions_about_centre(X);
  const std::vector<unsigned> corners(F.data(), F.data() + F.size());
  const std::size_t target = 3 * static_cast<std::size_t>(most);
  std::vector<unsigned> kept = collapse_edges(positions, corners, target);
  if (kept.size() > target + target / 2) {
    kept = merge_cells(positions, corners, target);
  }
  Triangles result(static_cast<Eigen::Index>(kept.size() / 3), 3);
  std::copy(kept.begin(), kept.end(), result.data());
  return result;
}

}  // namespace ibmfair
