// The law that every gradient must obey: it agrees with differences of the energy.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "support/states.h"

namespace ibmfair::test {

/// The gradient of the energy at X agrees with central differences along a random direction. With
/// half the step (in units of `edge`, the mean edge length), the error is below `tolerance`, and
/// the error is of second order in the step.
inline void expect_exact_gradient(BendingEnergy& energy, const Points& X, double edge, double step,
                                  double tolerance, const std::string& name) {
  Points G;
  const double E = energy.energy_and_gradient(X, G);
  EXPECT_NEAR(E, energy.energy(X), 1e-12 * E) << name;
  const Points D = random_directions(X.rows(), 3);
  const double exact = G.cwiseProduct(D).sum();
  const auto error = [&](double part) {
    const double h = part * edge;
    return std::abs((energy.energy(X + h * D) - energy.energy(X - h * D)) / (2 * h) - exact);
  };
  const double coarse = error(step), fine = error(step / 2);
  EXPECT_LT(fine, tolerance * (std::abs(exact) + E / edge)) << name;
  // Halving the step divides the error by four, down to rounding.
  const double rounding = 1e-11 * E / (step / 2 * edge);
  EXPECT_LT(fine, coarse / 3.5 + rounding) << name;
}

}  // namespace ibmfair::test
