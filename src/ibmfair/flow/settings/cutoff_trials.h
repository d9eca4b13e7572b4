// Flows with longer and longer cut-off wavelengths. For each, the noise that it leaves plus the
// part of the shape that it removes (the risk) is estimated from the noisy mesh alone.
//
// Let F be a smoother that is nearly linear in the heights of the vertices over the surface, and
// let y = x + noise be the noisy heights. The expected mean squared distance of F y to x is
//
//   risk = |y - F y|^2 / n + 2 s^2 tr F / n - s^2
//
// with s the standard deviation of the noise: C. Stein, "Estimation of the mean of a multivariate
// normal distribution", Annals of Statistics 9 (1981). No term needs x. F is not known as a matrix,
// so tr F is estimated as the mean of z^T F z over random z (S. Ramani, T. Blu, M. Unser,
// "Monte-Carlo SURE", IEEE Transactions on Image Processing 17, 2008), and s as the distance by
// which the flow with a short cut-off moves the vertices, over the distance by which it moves white
// noise.
//
// F z is computed by the flow linearised at the end state. If creases are kept, so that sharp
// hinges (edges with their two triangles) hardly bend, that linearisation misses the hinges that
// were sharp at first and no longer are. Then a small multiple of z is added to the mesh, and F z
// is the difference of the two flows' results over that multiple, as in the second paper.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/flow/settings/noise_kind.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class FlowProblem;

struct CutoffTrial {
  double cutoff = 0;  ///< length
  double risk = 0;    ///< length^2; may be negative by chance if the true risk is close to 0
};

/// Each flow continues from the end of the previous flow: of the time of a cut-off, three quarters
/// come after the end of the cut-off that is shorter by the square root of two. Flows of few steps
/// start anew, because backward Euler with long steps gives another result than with short steps.
/// Flows that keep creases start anew at the end of their first stage (flow/first_stage.h), because
/// their result depends on when each hinge is sharp.
class CutoffTrials {
 public:
  /// `topology` and `fixed` must outlive this object. The options must keep neither volume nor
  /// area; their sharp angle is not used (`restart` sets it). Only the vertices flagged in
  /// `counted` (#V, or empty for all) enter the risk. `noise`: its standard deviation along the
  /// normals, length; 0: estimated in the second trial. Throws BadMesh if no counted vertex moves.
  CutoffTrials(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
               const FlowOptions& options, const std::vector<std::uint8_t>& counted,
               double noise = 0);

  /// Forgets all trials, but not the noise. Later trials use `sharp_angle` as
  /// FlowOptions::sharp_angle. If it is positive, the noise must be known already: noise makes
  /// sharp hinges as well, so that flows that keep them cannot estimate the noise.
  void restart(double sharp_angle);

  /// Runs a trial. Cut-offs (length) must increase from trial to trial. Throws the exceptions of
  /// the flow.
  void run(double cutoff);

  /// Whether the noise is known. A known noise may be 0.
  bool know_noise() const { return knows_noise_; }
  double noise() const { return noise_; }
  /// Whether the noise has outliers. False if the noise was given.
  bool has_outliers() const { return has_outliers_; }

  /// What the trials without creases removed, one after the other.
  const std::vector<NoiseBand>& bands() const { return bands_; }

  /// The risks of all trials. Precondition: the noise is known.
  std::vector<CutoffTrial> risks() const;

 private:
  /// The result of a flow with one cut-off.
  struct Outcome {
    double cutoff;
    double squared_move;  // mean of the squared moves along the normals
    double trace;         // tr F / n
  };

  /// The states of a mesh that flows from cut-off to cut-off.
  struct Trajectory {
    Points start, state = {};
    Points after_first_stage = {};
    double first_stage_time = 0;
  };

  bool keeps_creases() const { return options_.sharp_angle > 0; }
  void flow_to(double cutoff);
  void flow_on(Trajectory& trajectory, bool goes_on) const;
  void begin(Trajectory& trajectory, FlowProblem& problem) const;
  void end_at(const Trajectory& trajectory, FlowProblem& problem) const;
  Points taken_of_noise(FlowProblem& problem);
  double trace_by_second_flow(const Points& end, const Points& normals) const;
  void add_band(double cutoff, const Points& normals, const Points& end, const Points& taken);
  void estimate_noise(const Eigen::VectorXd& height, const Points& taken);
  double trace_by_law(double cutoff) const;
  bool falls_by_law(double cutoff, double trace) const;

  const Topology& topology_;
  const std::vector<std::uint8_t>& fixed_;
  const CompressedRows rings_;
  const double mean_edge_;
  FlowOptions options_;  // of a flow from the start to the cut-off
  FlowOptions leg_;      // of the flow from the previous cut-off to this one
  Unknowns unknowns_;
  std::vector<Index> counted_;  // unknowns whose vertices are counted
  Points white_noise_;  // #unknowns x 3: three vectors take little longer to smooth than one
  Points smooth_;       // the white noise after the linearised flow
  Trajectory mesh_,
      moved_;        // the mesh, and with creases a copy moved by a little of the white noise
  double time_ = 0;  // flow time of these two
  std::vector<Outcome> outcomes_;
  std::vector<NoiseBand> bands_;
  Points end_, taken_;  // of the last trial without creases: the mesh, the white noise removed
  bool trace_falls_ = false;  // tr F follows Weyl's law from here on (trace_by_law)
  double noise_;
  bool knows_noise_;
  bool has_outliers_ = false;
};

}  // namespace ibmfair
