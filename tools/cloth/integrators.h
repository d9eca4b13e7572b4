// The table of time integrators.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "cloth/elastic_sheet.h"
#include "cloth/surroundings.h"

namespace ibmfair::cloth {

/// Where the vertices are and how they move: #V x 3 each, metres and metres a second.
struct Motion {
  Points X, V;
  double time = 0;  ///< seconds
};

/// At rest at X.
Motion at_rest(const Points& X);

struct StepOptions {
  double time_step = 0;        ///< seconds; 0: the integrator chooses
  int newton_iterations = 10;  ///< at most in a step, >= 1; 1 is the semi-implicit method
  double tolerance = 5e-3;     ///< Newton's method ends where no vertex moves further, mean edges
};

class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Advances by one time step. The motion must be the one that the step before has left. Throws
  /// FactorizationFailed.
  virtual void step(Motion& motion) = 0;
  virtual double time_step() const = 0;
};

struct IntegratorRow {
  std::string_view name;     ///< as the command line takes it
  std::string_view summary;  ///< one line
  /// Refers to plate and surroundings.
  std::unique_ptr<Integrator> (*bind)(const Plate& plate, const Surroundings& surroundings,
                                      const BendingForce& bending, const StepOptions& options);
};

std::span<const IntegratorRow> integrators();

/// The integrator of that name; throws BadOption, naming those there are.
const IntegratorRow& integrator(std::string_view name);

/// Advances by at least `seconds` in steps of equal length.
void advance(Integrator& integrator, double seconds, Motion& motion);

}  // namespace ibmfair::cloth
