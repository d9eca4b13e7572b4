// The angle by which a hinge is bent, with its first and second derivatives in closed form
// (gradient: [W07] appendix; Hessian: after Tamstorf, Grinspun, "Discrete bending forces and their
// Jacobians", Graphical Models 75 (2013)).
//
// The hinge has edge x0 x1, and x2, x3 opposite it in the triangles (x0,x1,x2) and (x1,x0,x3). Of
// either triangle, n is the unit normal, m the unit vector in its plane from the edge towards its
// opposite vertex, h its height over the edge and t the place of the foot of that height on the
// edge, 0 at x0 and 1 at x1. With the edge's length l and unit vector e and, for the vertices
// (x0, x1, opposite), w = (t - 1, -t, 1) and s = (-1, 1, 0),
//
//   grad_i phi  =   sum over both triangles of  w_i n / h
//   hess_ij phi = - sum over both triangles of  (n (w_j a_i)^T + w_i a_j n^T) / h
//                                               + s_i s_j (m n^T + n m^T) / (2 l^2)
//
// where a_i = w_i m / h + s_i e / l.
#pragma once

#include <array>
#include <cmath>

#include "ibmfair/base/types.h"

namespace ibmfair::cloth {

/// A hinge with triangles of positive area.
class BentHinge {
 public:
  BentHinge(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 edge = x1 - x0, f = x2 - x0, g = x3 - x0;
    const double squared = edge.squaredNorm();
    length = std::sqrt(squared);
    N[0] = edge.cross(f);
    N[1] = g.cross(edge);
    t = {f.dot(edge) / squared, g.dot(edge) / squared};
    e = edge / length;
    angle = std::atan2(length * g.dot(N[0]), N[0].dot(N[1]));
  }

  /// phi in [-pi, pi], radians: 0 where flat, positive where x3 is above (x0,x1,x2). [W07]'s theta
  /// is pi - |phi|.
  double angle;

  /// The gradient with respect to x0 .. x3, 1/length.
  std::array<Vec3, 4> gradient() const {
    const Vec3 u0 = length / N[0].squaredNorm() * N[0], u1 = length / N[1].squaredNorm() * N[1];
    return {(t[0] - 1) * u0 + (t[1] - 1) * u1, -t[0] * u0 - t[1] * u1, u0, u1};
  }

  double length;  ///< l
  Vec3 e;
  std::array<Vec3, 2> N;  ///< normals of twice the triangles' areas
  std::array<double, 2> t;
};

/// d^2 phi / dx_i dx_j, 1/length^2, of the pairs (0,0), (1,0), (1,1), (2,0), ..., (3,3).
std::array<Eigen::Matrix3d, 10> hessian(const BentHinge& hinge);

}  // namespace ibmfair::cloth
