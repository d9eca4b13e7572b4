#include "cloth/explicit_euler.h"

#include <cmath>

#include "ibmfair/base/random_numbers.h"

namespace ibmfair::cloth {
namespace {

constexpr double safety = 0.5;  // because a deformed sheet is stiffer
constexpr int power_iterations = 60;

/// A lower estimate of the largest eigenvalue of M^-1 H.
double largest_eigenvalue(const BlockHessian& H, const PerVertex& mass) {
  RandomNumbers random(1);
  Points X(mass.size(), 3);
  for (double& x : X.reshaped<Eigen::RowMajor>()) {
    x = random.normal();
  }
  double eigenvalue = 0;
  for (int i = 0; i < power_iterations; ++i) {
    X /= X.norm();
    X = H.multiply(X).array().colwise() / mass.array();
    eigenvalue = X.norm();
  }
  return eigenvalue;
}

class ExplicitEuler final : public Integrator {
 public:
  ExplicitEuler(const Plate& plate, const Surroundings& surroundings, const BendingForce& bending,
                const StepOptions& options)
      : plate_(plate), surroundings_(surroundings), sheet_(plate, bending) {
    h_ = options.time_step > 0 ? options.time_step : stable_time_step(plate, sheet_);
    step_over_mass_ = h_ * plate.mass.cwiseInverse();
  }

  void step(Motion& motion) override {
    Points& X = motion.X;
    Points& V = motion.V;
    external_forces(plate_, surroundings_, X, V, force_);
    gradient_.setZero(X.rows(), 3);
    for (EnergyTerm* term : {sheet_.membrane.get(), sheet_.bending.get()}) {
      term->add_gradient(X, gradient_);
      term->start_step(X, plate_.material.strain_damping / h_);
    }
    const double decay = 1 / (1 + h_ * plate_.material.mass_damping);
    for (Index v = 0; v < X.rows(); ++v) {
      if (!plate_.fixed[v]) {
        V.row(v) = decay * (V.row(v) + step_over_mass_[v] * (force_.row(v) - gradient_.row(v)));
        X.row(v) += h_ * V.row(v);
      }
    }
    if (const auto& sphere = surroundings_.sphere) {
      push_out(*sphere, sphere->resting_radius(), plate_, X, V);
    }
    motion.time += h_;
  }

  double time_step() const override { return h_; }

 private:
  const Plate& plate_;
  const Surroundings& surroundings_;
  ElasticSheet sheet_;
  double h_;
  PerVertex step_over_mass_;
  Points force_, gradient_;
};

}  // namespace

double stable_time_step(const Plate& plate, ElasticSheet& sheet) {
  sheet.hessian.clear();
  sheet.membrane->add_hessian(plate.rest, HessianPart::positive, sheet.hessian);
  sheet.bending->add_hessian(plate.rest, HessianPart::positive, sheet.hessian);
  const double squared = largest_eigenvalue(sheet.hessian, plate.mass);
  const double alpha = plate.material.strain_damping;
  return safety * (std::sqrt(alpha * alpha + 4 / squared) - alpha);
}

std::unique_ptr<Integrator> bind_explicit_euler(const Plate& plate,
                                                const Surroundings& surroundings,
                                                const BendingForce& bending,
                                                const StepOptions& options) {
  return std::make_unique<ExplicitEuler>(plate, surroundings, bending, options);
}

}  // namespace ibmfair::cloth
