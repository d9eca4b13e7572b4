// The cut-off that takes the most noise and the least of the shape, out of the noisy mesh alone:
// that of the least risk among some (flow/cutoff_trials.h).
//
// The noise must be independent from vertex to vertex: of the steps between the slices of a
// scanner, say, nothing is seen here.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ibmfair/flow/cutoff_trials.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/local_mesh.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct CutoffChoice {
  double cutoff = 0;                ///< length
  double noise = 0;                 ///< standard deviation along the normals, length
  std::vector<CutoffTrial> trials;  ///< with increasing cut-off

  const CutoffTrial& best() const;  ///< that of the least risk
  double before_best() const;       ///< the cut-off tried before that one, or its own
};

/// Told before each trial.
using TrialObserver = std::function<void(double cutoff)>;

struct CutoffSearch {
  double largest = 0;  ///< cut-off that is tried, length
  TrialObserver observer = {};
  double noise = 0;       ///< as in CutoffChoice; 0: told by the mesh
  Index enough = 50'000;  ///< vertices: where many more move, a sample of so many tells all
};

/// Lets copies of a mesh flow through cut-offs, each longer by the square root of two, up to the
/// largest or until the risk has clearly risen or hardly changes; the choice is between those
/// around the least. Volume and area are not kept. Deterministic.
class CutoffChooser {
 public:
  /// Refers to the mesh and `held`. The options say how it is to flow, but for the total time and
  /// the creases. Throws BadMesh where no vertex moves.
  CutoffChooser(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
                const FlowOptions& options, CutoffSearch search);

  double mean_edge_length() const { return mean_edge_length_; }

  /// From the cut-off `shortest` on (length), with FlowOptions::sharp_angle as given. Throws what
  /// the flow throws.
  CutoffChoice choose(double sharp_angle, double shortest);

 private:
  void take_sample(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
                   const FlowOptions& options);
  template <class Done>
  void try_cutoffs(double shortest, const Done& done);

  const double mean_edge_length_;
  const CutoffSearch search_;
  std::optional<LocalMesh> local_;     // stands for the mesh
  std::vector<std::uint8_t> counted_;  // of its vertices, or empty for all
  std::optional<CutoffTrials> trials_;
};

/// The choice from the shortest cut-off on that can be told from none, with the creases that the
/// options say.
CutoffChoice choose_cutoff(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& held, const FlowOptions& options,
                           const CutoffSearch& search);

}  // namespace ibmfair
