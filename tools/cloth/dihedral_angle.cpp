#include "cloth/dihedral_angle.h"

namespace ibmfair::cloth {

namespace {

/// One triangle's part of the Hessian.
struct Side {
  Eigen::Matrix3d P;        // s_0 s_0 (m n^T + n m^T) / (2 l^2), with the sign of the sum
  Vec3 u;                   // - n / h
  std::array<double, 3> w;  // of x0, x1, opposite
  std::array<Vec3, 3> a;

  Side(const BentHinge& hinge, int side) {
    const double l = hinge.length, double_area = hinge.N[side].norm(), h = double_area / l;
    const double t = hinge.t[side];
    const Vec3 n = hinge.N[side] / double_area;
    const Vec3 m = side == 0 ? n.cross(hinge.e) : hinge.e.cross(n);
    const Vec3 scaled = m / (-2 * l * l);
    P = scaled * n.transpose();
    P += P.transpose().eval();
    u = n / -h;
    w = {t - 1, -t, 1};
    a = {w[0] / h * m - hinge.e / l, w[1] / h * m + hinge.e / l, m / h};
  }

  /// The Hessian without P, which is present only for pairs of x0 and x1.
  Eigen::Matrix3d pair(int i, int j) const {
    return u * (w[j] * a[i]).transpose() + (w[i] * a[j]) * u.transpose();
  }
};

}  // namespace

std::array<Eigen::Matrix3d, 10> hessian(const BentHinge& hinge) {
  const Side one(hinge, 0), other(hinge, 1);
  const Eigen::Matrix3d P = one.P + other.P;
  return {one.pair(0, 0) + other.pair(0, 0) + P,
          one.pair(1, 0) + other.pair(1, 0) - P,
          one.pair(1, 1) + other.pair(1, 1) + P,
          one.pair(2, 0),
          one.pair(2, 1),
          one.pair(2, 2),
          other.pair(2, 0),
          other.pair(2, 1),
          Eigen::Matrix3d::Zero(),  // no triangle has both x2 and x3
          other.pair(2, 2)};
}

}  // namespace ibmfair::cloth
