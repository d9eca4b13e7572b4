// Surfaces that turn sharply although they have no noise.
#pragma once

#include <cmath>
#include <numbers>

#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {

inline constexpr double degree = std::numbers::pi / 180;

/// A sheet folded along its middle row, so that its halves enclose this angle.
inline State wedge(double angle) {
  State state(make_shape("plane", {.rows = 25, .columns = 40}));
  state.X.col(1).array() -= state.X.col(1).mean();
  for (auto x : state.X.rowwise()) {
    const double across = x[1];
    x[1] = std::abs(across) * std::cos(angle / 2);
    x[2] = across * std::sin(angle / 2);
  }
  return state;
}

/// A disc drawn up to a cone with this angle between its axis and its side.
inline State needle(double angle) {
  State state(make_shape("hexagon", {.subdivide = 4}));
  for (auto x : state.X.rowwise()) {
    x[2] = -x.head<2>().norm() / std::tan(angle);
  }
  return state;
}

}  // namespace ibmfair::test
