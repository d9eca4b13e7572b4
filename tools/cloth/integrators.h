// The table of time integrators.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "cloth/elastic_sheet.h"
#include "cloth/surroundings.h"

namespace ibmfair::cloth {

/// Positions and velocities of the vertices: #V x 3 each, metres and metres per second.
struct Motion {
  Points X, V;
  double time = 0;  ///< seconds
};

/// The motion at rest with positions X.
Motion at_rest(const Points& X);

struct StepOptions {
  double time_step = 0;        ///< seconds; 0: the integrator chooses
  int newton_iterations = 10;  ///< at most in a step, >= 1; 1 is the semi-implicit method
  double tolerance = 5e-3;     ///< Newton's method ends when no vertex moves further, mean edges
};

class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Advances by one time step. The motion must be the result of the previous step. Throws
  /// FactorizationFailed.
  virtual void step(Motion& motion) = 0;
  virtual double time_step() const = 0;
};

struct IntegratorRow {
  std::string_view name;     ///< name on the command line
  std::string_view summary;  ///< one line
  /// Refers to plate and surroundings.
  std::unique_ptr<Integrator> (*create)(const Plate& plate, const Surroundings& surroundings,
                                        const BendingForce& bending, const StepOptions& options);
};

std::span<const IntegratorRow> integrators();

/// The integrator with that name; throws BadOption, whose message lists all names.
const IntegratorRow& integrator(std::string_view name);

/// Advances by at least `seconds` in steps of equal length.
void advance(Integrator& integrator, double seconds, Motion& motion);

}  // namespace ibmfair::cloth
