#include "ibmfair/flow/settings/no_noise.h"

#include <numbers>

#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

double share_of_flat_hinges(const Points& X, const Topology& topology) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  return angles.size() == 0
             ? 0
             : static_cast<double>(
                   (angles.array() > std::numbers::pi - choice_tuning.noise.flat).count()) /
                   static_cast<double>(angles.size());
}

}  // namespace

bool is_without_noise(const Points& X, const Topology& topology, const CutoffChoice& choice) {
  const double negligible =
      choice.looks_white ? choice_tuning.noise.negligible_white : choice_tuning.noise.negligible;
  const bool too_little = choice.kind == NoiseKind::independent &&
                          choice.noise < negligible * mean_edge_length(X, topology.E);
  return too_little || (choice.kind != NoiseKind::outliers &&
                        share_of_flat_hinges(X, topology) > choice_tuning.noise.flat_hinges);
}

}  // namespace ibmfair
