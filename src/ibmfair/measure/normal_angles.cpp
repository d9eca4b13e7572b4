#include "ibmfair/measure/normal_angles.h"

#include <cmath>
#include <limits>
#include <vector>

#include "ibmfair/base/angle.h"

namespace ibmfair {

double degrees_between(const Vec3& a, const Vec3& b) {
  const double size_a = a.cwiseAbs().maxCoeff();
  const double size_b = b.cwiseAbs().maxCoeff();
  if (!(size_a > 0.0 && size_b > 0.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Vec3 u = a / size_a;
  const Vec3 v = b / size_b;
  return degrees(std::atan2(u.cross(v).norm(), u.dot(v)));
}

NormalAngles summarise_angles(const Eigen::VectorXd& degrees) {
  NormalAngles result;
  std::vector<double> known;
  std::vector<Index> pair;
  for (Index i = 0; i < degrees.size(); ++i) {
    if (std::isnan(degrees[i])) {
      ++result.left_out;
    } else {
      known.push_back(degrees[i]);
      pair.push_back(i);
      result.flipped += degrees[i] > 90.0 ? 1 : 0;
    }
  }
  result.degrees = summarise(
      Eigen::Map<const Eigen::VectorXd>(known.data(), static_cast<Eigen::Index>(known.size())));
  if (!known.empty()) {
    result.degrees.where = pair[static_cast<std::size_t>(result.degrees.where)];
  }
  return result;
}

}  // namespace ibmfair
