#include "cloth/dihedral_angle.h"

namespace ibmfair::cloth {

std::array<Eigen::Matrix3d, 10> hessian(const BentHinge& hinge) {
  std::array<Eigen::Matrix3d, 10> H;
  H[8].setZero();  // no triangle has both x2 and x3
  const double l = hinge.length;
  const std::array<double, 3> s{-1, 1, 0};
  for (int side = 0; side < 2; ++side) {
    const double double_area = hinge.N[side].norm(), h = double_area / l, t = hinge.t[side];
    const Vec3 n = hinge.N[side] / double_area;
    const Vec3 m = side == 0 ? n.cross(hinge.e) : hinge.e.cross(n);
    const std::array<double, 3> w{t - 1, -t, 1};
    const Eigen::Matrix3d nm = n * m.transpose(), P = -(nm + nm.transpose());
    const Eigen::Matrix3d Q = -1 / (h * l) * hinge.e * n.transpose();
    // The pairs of x0, x1 and this side's opposite vertex among the ten.
    const std::array<int, 6> place =
        side == 0 ? std::array{0, 1, 2, 3, 4, 5} : std::array{0, 1, 2, 6, 7, 9};
    for (int i = 0, k = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        const Eigen::Matrix3d part = (w[i] * w[j] / (h * h) + s[i] * s[j] / (2 * l * l)) * P +
                                     s[i] * w[j] * Q.transpose() + w[i] * s[j] * Q;
        Eigen::Matrix3d& sum = H[place[k]];
        if (side == 1 && k < 3) {
          sum += part;
        } else {
          sum = part;
        }
      }
    }
  }
  return H;
}

}  // namespace ibmfair::cloth
