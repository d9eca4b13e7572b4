#include "ibmfair/flow/settings/no_noise.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>

#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// What a mesh has of flat hinges. Noise bends all hinges at the vertices that it moves.
struct Flatness {
  double flat_hinges;    ///< ratio of the hinges that are flat
  double bent_vertices;  ///< ratio of the vertices without a flat hinge
};

Flatness flatness(const Points& X, const Topology& topology) {
  const Eigen::VectorXd angles = dihedral_angles(X, topology.H);
  std::vector<std::uint8_t> is_bent(static_cast<std::size_t>(X.rows()), 1);
  Index flat = 0;
  for (Eigen::Index h = 0; h < angles.size(); ++h) {
    if (angles[h] > std::numbers::pi - choice_tuning.noise.flat) {
      ++flat;
      is_bent[topology.H(h, 0)] = is_bent[topology.H(h, 1)] = 0;
    }
  }
  const auto share = [](auto part, auto all) {
    return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
  };
  return {share(flat, angles.size()), share(std::ranges::count(is_bent, 1), is_bent.size())};
}

}  // namespace

bool is_without_noise(const Points& X, const Topology& topology, const CutoffChoice& choice) {
  const double edge = mean_edge_length(X, topology.E);
  const double negligible =
      choice.looks_white ? choice_tuning.noise.negligible_white : choice_tuning.noise.negligible;
  const bool too_little =
      choice.kind == NoiseKind::independent && choice.noise.deviation < negligible * edge;
  if (too_little || choice.kind == NoiseKind::outliers) {
    return too_little;
  }
  const Flatness found = flatness(X, topology);
  // Noise that is only in some places leaves the hinges of other planes flat.
  const bool is_uneven = choice.white_noise >= choice_tuning.noise.negligible * edge &&
                         found.bent_vertices > choice_tuning.noise.bent_vertices;
  return found.flat_hinges > choice_tuning.noise.flat_hinges && !is_uneven;
}

}  // namespace ibmfair
