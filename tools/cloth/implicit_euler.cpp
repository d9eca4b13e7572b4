#include "cloth/implicit_euler.h"

#include <cmath>
#include <vector>

#include "cloth/block_solver.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::cloth {
namespace {

constexpr double default_time_step = 0.01;  // seconds
constexpr double sufficient_decrease = 1e-4;
constexpr double shortest_step = 1e-4;  // as a share of the Newton step
constexpr double rounding = 1e-12;      // relative, of Phi

class ImplicitEuler final : public Integrator {
 public:
  ImplicitEuler(const Plate& plate, const Surroundings& surroundings, const BendingForce& bending,
                const StepOptions& options)
      : plate_(plate),
        surroundings_(surroundings),
        h_(options.time_step > 0 ? options.time_step : default_time_step),
        newton_iterations_(options.newton_iterations),
        smallest_move_(options.tolerance * mean_edge_length(plate.rest, plate.topology.E)),
        inertia_((1 / (h_ * h_)) * plate.mass),
        sheet_(plate, bending),
        solver_(sheet_.hessian, plate.fixed, plate.rest) {
    terms_ = {sheet_.membrane.get(), sheet_.bending.get()};
    if (surroundings.sphere) {
      contact_ = bind_contact(*surroundings.sphere, plate, h_, sheet_.hessian);
      terms_.push_back(contact_.get());
    }
  }

  void step(Motion& motion) override {
    X_ = motion.X;
    predicted_ = X_ + h_ * motion.V;
    external_forces(plate_, surroundings_, X_, motion.V, force_);
    for (EnergyTerm* term : terms_) {
      term->energy(X_);
      term->start_step(X_, plate_.material.strain_damping / h_);
    }
    for (int i = 0; i < newton_iterations_ && newton_step(motion.X); ++i) {
    }
    motion.V = (motion.X - X_) / h_;
    if (const auto& sphere = surroundings_.sphere) {
      push_out(*sphere, sphere->radius, plate_, motion.X, motion.V);
    }
    motion.time += h_;
  }

  double time_step() const override { return h_; }

 private:
  double damping() const { return h_ * plate_.material.mass_damping; }

  /// Phi(X).
  double potential(const Points& X) const {
    const auto sum = [&](const Points& D) { return inertia_.dot(D.rowwise().squaredNorm()) / 2; };
    double value =
        sum(X - predicted_) + damping() * sum(X - X_) - force_.cwiseProduct(X - X_).sum();
    for (EnergyTerm* term : terms_) {
      value += term->energy(X);
    }
    return value;
  }

  /// The gradient of Phi, 0 at vertices that are fixed.
  void gradient(const Points& X, Points& G) const {
    G = inertia_.asDiagonal() * (X - predicted_ + damping() * (X - X_)) - force_;
    for (EnergyTerm* term : terms_) {
      term->add_gradient(X, G);
    }
    for (Index v = 0; v < X.rows(); ++v) {
      if (plate_.fixed[v]) {
        G.row(v).setZero();
      }
    }
  }

  void factor(const Points& X, HessianPart bending) {
    sheet_.hessian.clear();
    for (EnergyTerm* term : terms_) {
      const bool bends = term == sheet_.bending.get();
      term->add_hessian(X, bends ? bending : HessianPart::positive, sheet_.hessian);
    }
    solver_.factor(sheet_.hessian, (1 + damping()) * inertia_);
  }

  /// The membrane's Hessian is always made positive, because a compressed sheet buckles. The
  /// bending Hessian is seldom indefinite and is made positive only when needed.
  void factor(const Points& X) {
    try {
      factor(X, HessianPart::exact);
    } catch (const FactorizationFailed&) {
      factor(X, HessianPart::positive);
    }
  }

  /// Moves X by one iteration; returns false if that was the last iteration.
  bool newton_step(Points& X) {
    gradient(X, gradient_);
    factor(X);
    solver_.solve(gradient_, direction_);
    const double slope = -gradient_.cwiseProduct(direction_).sum();
    const double start = potential(X);
    double length = 1;
    while (length >= shortest_step) {
      trial_ = X - length * direction_;
      const double bound =
          start + sufficient_decrease * length * slope + rounding * std::abs(start);
      if (potential(trial_) <= bound) {
        X.swap(trial_);
        return length * direction_.rowwise().norm().maxCoeff() > smallest_move_;
      }
      length /= 2;
    }
    return false;
  }

  const Plate& plate_;
  const Surroundings& surroundings_;
  double h_;
  int newton_iterations_;
  double smallest_move_;
  PerVertex inertia_;  // mass / h^2
  ElasticSheet sheet_;
  std::unique_ptr<EnergyTerm> contact_;
  std::vector<EnergyTerm*> terms_;
  BlockSolver solver_;
  Points X_, predicted_, force_;  // at the start of the step
  Points gradient_, direction_, trial_;
};

}  // namespace

std::unique_ptr<Integrator> bind_implicit_euler(const Plate& plate,
                                                const Surroundings& surroundings,
                                                const BendingForce& bending,
                                                const StepOptions& options) {
  return std::make_unique<ImplicitEuler>(plate, surroundings, bending, options);
}

}  // namespace ibmfair::cloth
