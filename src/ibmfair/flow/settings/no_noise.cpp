#include "ibmfair/flow/settings/no_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/flow/settings/hinge_noise.h"
#include "ibmfair/flow/settings/level_steps.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// What a mesh has of flat hinges. Noise bends all hinges at the vertices that it moves.
struct Flatness {
  double flat_hinges;    ///< ratio of the hinges that are flat
  double bent_vertices;  ///< ratio of the vertices without a flat hinge
};

/// Of the vertices that are not fixed, and the hinges at them. `noise`: of independent noise, the
/// standard deviation (length), else 0.
Flatness flatness(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
                  double noise) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  std::vector<std::uint8_t> is_bent(fixed.size());
  std::ranges::transform(fixed, is_bent.begin(), [](std::uint8_t is_fixed) { return !is_fixed; });
  const auto free_vertices = std::ranges::count(is_bent, 1);
  Index flat = 0, hinges = 0;
  for (Eigen::Index h = 0; h < angles.size(); ++h) {
    if (fixed[topology.H(h, 0)] && fixed[topology.H(h, 1)]) {
      continue;
    }
    ++hinges;
    const double by_noise =
        noise > 0 ? choice_tuning.noise.unlikely_bend * noise * bend_by_noise(X, topology.H, h) : 0;
    if (std::numbers::pi - angles[h] < std::max(choice_tuning.noise.flat, by_noise)) {
      ++flat;
      is_bent[topology.H(h, 0)] = is_bent[topology.H(h, 1)] = 0;
    }
  }
  const auto share = [](auto part, auto all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  return {share(flat, hinges), share(std::ranges::count(is_bent, 1), free_vertices)};
}

}  // namespace

bool is_without_noise(const Points& X, const Topology& topology,
                      const std::vector<std::uint8_t>& fixed, const CutoffChoice& choice) {
  const double edge = mean_edge_length(X, topology.E);
  const double negligible =
      choice.looks_white ? choice_tuning.noise.negligible_white : choice_tuning.noise.negligible;
  const bool is_independent = choice.kind == NoiseKind::independent;
  const bool too_little = is_independent && choice.noise.deviation < negligible * edge;
  if (too_little || choice.kind == NoiseKind::outliers) {
    return too_little;
  }
  const Flatness found = flatness(X, topology, fixed, is_independent ? choice.noise.deviation : 0);
  // Noise that is only in some places leaves the hinges of other planes flat, and rounded
  // coordinates hide noise that is smaller than their steps.
  const bool is_uneven = choice.white_noise >= choice_tuning.noise.negligible * edge &&
                         found.bent_vertices > choice_tuning.noise.bent_vertices;
  return found.flat_hinges > choice_tuning.noise.flat_hinges && !is_uneven &&
         !is_rounded(X, topology);
}

}  // namespace ibmfair
