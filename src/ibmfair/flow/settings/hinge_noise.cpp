#include "ibmfair/flow/settings/hinge_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

double bend_by_noise(const Points& X, const Hinges& H, Eigen::Index h) {
  const Vec3 a = X.row(H(h, 0)), b = X.row(H(h, 1));
  const double length = (b - a).norm();
  const double first = length / double_area_vector(a, b, X.row(H(h, 2))).norm();
  const double second = length / double_area_vector(a, b, X.row(H(h, 3))).norm();
  return std::hypot(first, second, (first + second) / std::numbers::sqrt2);
}

double noise_by_hinges(const Points& X, const Topology& topology,
                       const std::vector<std::uint8_t>& fixed) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  std::vector<double> deviations;  // times the magnitude of a normal number
  for (Eigen::Index h = 0; h < angles.size(); ++h) {
    if (!fixed[topology.H(h, 0)] || !fixed[topology.H(h, 1)]) {
      deviations.push_back((std::numbers::pi - angles[h]) / bend_by_noise(X, topology.H, h));
    }
  }
  if (deviations.empty()) {
    return 0;
  }
  // The quantiles of the magnitude of a normal number.
  const double tenth = quantile(deviations, 0.1) / 0.1257,
               quarter = quantile(deviations, 0.25) / 0.3186,
               half = quantile(deviations, 0.5) / 0.6745;
  const auto [least, most] = std::minmax({tenth, quarter, half});
  return most < choice_tuning.noise.same_by_hinges * least ? quarter : 0;
}

}  // namespace ibmfair
