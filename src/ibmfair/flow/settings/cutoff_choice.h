// Estimates, from the noisy mesh alone, the cut-off wavelength that removes the most noise and the
// least of the shape: among several cut-offs, the one with the least risk, an estimate of the mean
// squared distance to the true shape (flow/settings/cutoff_trials.h).
//
// The risk can be estimated only if the noise is independent from vertex to vertex. If the noise is
// correlated (flow/settings/noise_kind.h), the choice is the cut-off up to which all that it
// removes covers the surface evenly. Steps between the slices of a scanner, which are not
// everywhere, are not recognized as noise.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/settings/cutoff_trials.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct CutoffChoice {
  double cutoff = 0;  ///< length
  double noise = 0;   ///< standard deviation along the normals, length
  NoiseKind kind = NoiseKind::independent;
  bool looks_white = false;         ///< `is_white` of noise_kind.h; false with creases
  std::vector<CutoffTrial> trials;  ///< with increasing cut-off

  const CutoffTrial& best() const;  ///< the trial with the least risk
  double before_best() const;       ///< cut-off of the trial before `best`, or of `best` if first
};

/// Called before each trial.
using TrialObserver = std::function<void(double cutoff)>;

struct CutoffSearch {
  double largest = 0;  ///< the largest cut-off to try, length
  TrialObserver observer = {};
  double noise = 0;  ///< as in CutoffChoice; 0: estimated from the mesh
  /// Meshes with many more moving vertices are sampled: the size of the sample.
  Index enough = tuning.cutoff.sample;
};

/// Lets copies of a mesh flow to a sequence of cut-offs, each longer by the square root of two, up
/// to the largest or until the risk has clearly risen or hardly changes. The chosen cut-off is
/// interpolated around the trial with the least risk. Volume and area are not kept. Deterministic.
class CutoffChooser {
 public:
  /// The mesh and `fixed` must outlive this object. The total time and the sharp angle of `options`
  /// are not used. Throws BadMesh if all vertices are fixed.
  CutoffChooser(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
                const FlowOptions& options, CutoffSearch search);

  double mean_edge_length() const { return mean_edge_length_; }

  /// Chooses among cut-offs from `shortest` (length) upward, with `sharp_angle` as
  /// FlowOptions::sharp_angle. Throws the exceptions of the flow.
  CutoffChoice choose(double sharp_angle, double shortest);

 private:
  void take_sample(const Points& X, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const FlowOptions& options);
  template <class Done>
  void try_cutoffs(double shortest, const Done& done);
  bool looks_further(double next) const;

  const double mean_edge_length_;
  const CutoffSearch search_;
  std::optional<LocalMesh> local_;     // a sample or a renumbered copy, used in place of the mesh
  std::vector<std::uint8_t> counted_;  // flags of the vertices that count, or empty for all
  std::optional<CutoffTrials> trials_;
};

/// Chooses among cut-offs from two mean edge lengths upward, the shortest cut-off with a noticeable
/// effect, with the sharp angle of the options.
CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                           const CutoffSearch& search);

}  // namespace ibmfair
