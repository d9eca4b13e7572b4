// What a sheet's energy is made of. Each term is quadratic in some strains s(X): changes of length,
// of an angle, of curvature,
//
//   E(X) = 1/2 sum_s k_s |s(X) - s_rest|^2
//
// and is damped by their rates, so that damping, too, leaves rigid motions alone where the strains
// do. Within a time step h the rate is (s(X) - s(X_before)) / h, and the damping force with the
// coefficient alpha_2 of [W07] equation (9) is the gradient of
//
//   D(X) = 1/2 beta sum_s k_s |s(X) - s(X_before)|^2,        beta = alpha_2 / h
//
// That is Rayleigh damping with the part of the Hessian that comes from the strains' first
// derivatives: always positive semi-definite, and all of it where strains are linear.
#pragma once

#include "cloth/block_hessian.h"
#include "ibmfair/base/types.h"

namespace ibmfair::cloth {

/// `exact`: all second derivatives. `positive`: without what can make it indefinite.
enum class HessianPart : std::uint8_t { exact, positive };

/// A term of the energy, joules. X and G are #V x 3, metres and newtons.
class EnergyTerm {
 public:
  EnergyTerm() = default;
  EnergyTerm(const EnergyTerm&) = delete;
  EnergyTerm& operator=(const EnergyTerm&) = delete;
  virtual ~EnergyTerm() = default;

  /// E(X) + D(X).
  virtual double energy(const Points& X) = 0;

  /// Adds the gradient of E + D, which is minus the force.
  virtual void add_gradient(const Points& X, Points& G) = 0;

  /// Adds the Hessian of E + D.
  virtual void add_hessian(const Points& X, HessianPart part, BlockHessian& H) = 0;

  /// Makes X the X_before of what follows. `energy` or `add_gradient` must have been called for X
  /// last: the strains are those found then. Before the first call beta is 0.
  virtual void start_step(const Points& X, double beta) = 0;
};

}  // namespace ibmfair::cloth
