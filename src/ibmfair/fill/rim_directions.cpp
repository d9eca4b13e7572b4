#include "ibmfair/fill/rim_directions.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/QR>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr int fitted_rings = 3;  // around each vertex
constexpr int robust_passes = 4;

/// The heights of points above a plane, and a quadratic surface through them.
class HeightFit {
 public:
  HeightFit(const Points& X, const Vec3& origin, const Vec3& normal)
      : terms_(X.rows(), 6), height_((X.rowwise() - origin.transpose()) * normal) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const Points from = X.rowwise() - origin.transpose();
    const double length = std::sqrt(from.rowwise().squaredNorm().mean());
    const Eigen::ArrayXd x = from * u / length, y = from * v / length;
    terms_ << Eigen::ArrayXd::Ones(x.size()), x, y, x * x, x * y, y * y;
    fit();
  }

  /// Heights above the surface.
  const Eigen::VectorXd& offsets() const { return offset_; }

 private:
  /// Least squares with the weights of Cauchy's distribution.
  void fit() {
    const Eigen::Index columns = terms_.rows() >= 2 * terms_.cols() ? terms_.cols() : 3;
    const Eigen::MatrixXd terms = terms_.leftCols(columns);
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(terms.rows());
    for (int pass = 0; pass < robust_passes; ++pass) {
      const Eigen::VectorXd root = weight.cwiseSqrt();
      const Eigen::VectorXd solution =
          (root.asDiagonal() * terms).colPivHouseholderQr().solve(root.cwiseProduct(height_));
      offset_ = height_ - terms * solution;
      Eigen::VectorXd sorted = offset_.cwiseAbs();
      const auto middle = sorted.begin() + sorted.size() / 2;
      std::nth_element(sorted.begin(), middle, sorted.end());
      if (!(*middle > 0)) {
        return;
      }
      weight = (1 + (offset_ / (2 * *middle)).array().square()).inverse();
    }
  }

  Eigen::MatrixXd terms_;
  Eigen::VectorXd height_, offset_;
};

}  // namespace

void smooth_directions(const Points& X, const Topology& topology, Patch& patch) {
  std::vector<std::uint8_t> on_rim(static_cast<std::size_t>(topology.vertex_count), 0);
  for (const RimEdge& edge : patch.rim) {
    on_rim[patch.mesh_vertex[edge.a]] = 1;
  }
  for (Index i = 0; i < patch.own_from; ++i) {
    const Index vertex = patch.mesh_vertex[i];
    const std::vector<Index> near = grown_by_ring(topology, {vertex});
    const bool is_second =
        on_rim[vertex] == 0 && std::ranges::any_of(near, [&](Index v) { return on_rim[v] != 0; });
    const Vec3 N = double_area_vector_at(vertex, X, topology);
    if (!is_second || !(N.norm() > 0)) {
      continue;
    }
    std::vector<Index> band = near;
    for (int ring = 1; ring < fitted_rings; ++ring) {
      band = grown_by_ring(topology, band);
    }
    const Vec3 normal = N.normalized();
    const HeightFit fit(X(band, Eigen::all), X.row(vertex), normal);
    const auto offset = [&](Index v) {
      return fit.offsets()[std::lower_bound(band.begin(), band.end(), v) - band.begin()];
    };
    double sum = 0;
    int count = 0;
    for (const Index v : near) {
      sum += on_rim[v] != 0 ? offset(v) : 0;
      count += on_rim[v];
    }
    patch.X.row(i) += ((sum / count - offset(vertex)) * normal).transpose();
  }
}

}  // namespace ibmfair
