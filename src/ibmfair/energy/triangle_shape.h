// The metric of a triangle, on which the formulas of vertex-based Laplacians and masses depend.
#pragma once

#include <array>
#include <cmath>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/jet.h"

namespace ibmfair {

struct MaterialDirection;

/// Three numbers of a triangle: one per corner, or one per edge in the order of the opposite
/// corners.
template <class Number>
using ByCorner = std::array<Number, 3>;

template <class Number>
struct TriangleShape {
  ByCorner<Number> squared;  ///< lengths of the edges opposite the corners, squared
  ByCorner<Number> cot;      ///< cotangents of the angles
  Number area;
  ByCorner<Number> weight;  ///< of the vertices, length^2 (energy/circle_weights.h)
  const MaterialDirection* direction = nullptr;  ///< null if the formula uses no direction
};

/// Derivatives with respect to the squared lengths (0 .. 2) and the weights of the vertices (3 ..
/// 5).
using MetricJet = Jet<6>;

inline TriangleShape<double> triangle_shape(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  const Vec3 e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
  const double double_area = e1.cross(e2).norm();
  return {{e0.squaredNorm(), e1.squaredNorm(), e2.squaredNorm()},
          {-e1.dot(e2) / double_area, -e2.dot(e0) / double_area, -e0.dot(e1) / double_area},
          double_area / 2,
          {},
          nullptr};
}

/// The shape with its derivatives with respect to the squared lengths l_j^2. With 4 A cot_i = l_j^2
/// + l_k^2 - l_i^2 and Heron's formula, dA / d l_j^2 = cot_j / 4 and d cot_i / d l_j^2 = (+-1 -
/// cot_i cot_j) / (4 A), with the minus sign if i = j.
inline TriangleShape<MetricJet> differentiated(const TriangleShape<double>& shape) {
  TriangleShape<MetricJet> result;
  result.area = shape.area;
  result.direction = shape.direction;
  for (int i = 0; i < 3; ++i) {
    result.squared[i] = MetricJet::variable(shape.squared[i], i);
    result.weight[i] = MetricJet::variable(shape.weight[i], 3 + i);
    result.area.derivative[i] = shape.cot[i] / 4;
    result.cot[i] = shape.cot[i];
    for (int j = 0; j < 3; ++j) {
      result.cot[i].derivative[j] =
          ((i == j ? -1 : 1) - shape.cot[i] * shape.cot[j]) / (4 * shape.area);
    }
  }
  return result;
}

/// A formula for three numbers of a triangle, without and with derivatives.
struct TriangleFormula {
  ByCorner<double> (*value)(const TriangleShape<double>& shape);
  ByCorner<MetricJet> (*jet)(const TriangleShape<MetricJet>& shape);
};

/// A TriangleFormula made from a type whose static template `at` is the formula for any number
/// type.
template <class Formula>
constexpr TriangleFormula triangle_formula{Formula::template at<double>,
                                           Formula::template at<MetricJet>};

/// The next and the previous corner in the cyclic order 0, 1, 2.
constexpr int next(int corner) {
  return corner == 2 ? 0 : corner + 1;
}
constexpr int previous(int corner) {
  return corner == 0 ? 2 : corner - 1;
}

}  // namespace ibmfair
