#include "ibmfair/flow/flow_options.h"

#include <cmath>
#include <numbers>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

void require(bool holds, const char* message) {
  if (!holds) {
    throw BadOption(message);
  }
}

}  // namespace

void FlowOptions::validate() const {
  ibmfair::mass_matrix(bending_model(laplacian), {mass, {}, mass_matrix});
  require(steps >= 1, "the number of steps must be at least 1");
  require(total_time > 0 && std::isfinite(total_time),
          "the flow's time must be positive and finite");
  require(twicing >= 0, "the number of twicings must not be negative");
  require(newton_iterations >= 1, "the number of Newton iterations must be at least 1");
  require(solver_tolerance > 0 && solver_tolerance < 1,
          "--solver-tolerance must be above 0 and below 1");
  require(memory_limit > 0, "the memory limit must be positive");
  require(relaxation >= 0 && relaxation <= 1, "the relaxation must be between 0 and 1");
  require(max_move > 0, "the largest move must be positive");
  require(!(keep_volume || keep_area) || std::isinf(max_move),
          "--keep-volume and --keep-area cannot be combined with --max-move");
  require(sharp_angle >= 0 && sharp_angle <= std::numbers::pi,
          "the angle of --keep-sharp must be from 0 to 180 degrees");
  require(spontaneous_curvature.allFinite(), "the spontaneous curvature must be finite");
}

int FlowOptions::twicing_steps() const {
  return put_back_slides ? tuning.twicing.steps_of_moves : tuning.twicing.steps_of_heights;
}

EnergyOptions FlowOptions::energy_options() const {
  return {.mass = mass,
          .mass_matrix = mass_matrix,
          .material_directions = material_directions,
          .sharp_angle = sharp_angle,
          .spontaneous_curvature = spontaneous_curvature};
}

bool FlowOptions::counts_valence() const {
  return metric == Metric::mass &&
         ibmfair::mass_matrix(bending_model(laplacian), energy_options()).kind ==
             MassMatrix::Kind::counted;
}

bool FlowOptions::energy_is_dimensionless() const {
  return ibmfair::mass_matrix(bending_model(laplacian), energy_options()).measures_area();
}

void FlowSeconds::add(const FlowSeconds& more) {
  assemble += more.assemble;
  analyse += more.analyse;
  factor += more.factor;
  gradient += more.gradient;
  solve += more.solve;
  guard += more.guard;
  relax += more.relax;
  other += more.other;
}

void FlowReport::add_effort(const FlowReport& more) {
  solves += more.solves;
  factorizations += more.factorizations;
  rejected += more.rejected;
  shortened_relaxations += more.shortened_relaxations;
  iterations += more.iterations;
  seconds.add(more.seconds);
}

}  // namespace ibmfair
