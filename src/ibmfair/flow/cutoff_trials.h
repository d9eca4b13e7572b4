// Flows with longer and longer cut-offs, and what each leaves of the noise and takes of the shape,
// told by the noisy mesh alone.
//
// Of a smoother F that is nearly linear in the heights of the vertices over the surface, the mean
// squared distance of what it makes of y = x + noise to x is, in expectation,
//
//   risk = |y - F y|^2 / n + 2 s^2 tr F / n - s^2
//
// s the noise's standard deviation: C. Stein, "Estimation of the mean of a multivariate normal
// distribution", Annals of Statistics 9 (1981). No term needs x. As F is known only by what it
// does, tr F is z^T F z on the mean over random z (S. Ramani, T. Blu, M. Unser, "Monte-Carlo SURE",
// IEEE Transactions on Image Processing 17, 2008), and s is how far the flow with a short cut-off
// moves the vertices, over how far it moves white noise.
//
// F z is what the linearised flow at the end makes of z. Where hinges that turn sharply hardly
// bend, that knows nothing of those that did and no longer do: there it is the difference that a
// little of z in the mesh makes to the flow, over that little, as the second of the papers has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

class FlowProblem;

struct CutoffTrial {
  double cutoff = 0;  ///< length
  double risk = 0;    ///< length^2; below 0 by chance where next to nothing is left
};

/// Each flow goes on where the last one ended, as of a cut-off's time three quarters lie behind one
/// shorter by the square root of two; but for those of few steps, which begin anew: long steps of
/// backward Euler are not what shorter ones come to. Those that keep creases, where it matters
/// when which hinges hold, begin anew at the end of their first stage (flow/first_stage.h).
class CutoffTrials {
 public:
  /// Refers to all but the options, which must keep neither volume nor area; whatever they say, all
  /// hinges bend at first. Only what becomes of `counted` vertices is looked at (#V, or empty for
  /// all). `noise` is its standard deviation along the normals, length; 0: told by the second
  /// trial. Throws BadMesh where no vertex moves.
  CutoffTrials(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& held,
               const FlowOptions& options, const std::vector<std::uint8_t>& counted,
               double noise = 0);

  /// Forgets all trials, but not the noise; FlowOptions::sharp_angle of those to come is this one.
  /// Where it is positive, the noise must be known: as it makes creases, too, they cannot tell it.
  void restart(double sharp_angle);

  /// Cut-offs (length) must increase. Throws what the flow throws.
  void run(double cutoff);

  /// It may be 0, too.
  bool know_noise() const { return knows_noise_; }
  double noise() const { return noise_; }

  /// Of all trials; needs the noise.
  std::vector<CutoffTrial> risks() const;

 private:
  static constexpr std::size_t noise_trial = 1;  // shapes have little in it yet

  /// What a flow with one cut-off did.
  struct Outcome {
    double cutoff;
    double squared_move;  // along the normals, mean
    double trace;         // tr F / n
  };

  /// A mesh on its way through the cut-offs.
  struct Way {
    Points start, state = {};
    Points after_first_stage = {};
    double first_stage_time = 0;
  };

  bool keeps_creases() const { return options_.sharp_angle > 0; }
  void flow_to(double cutoff);
  void flow_on(Way& way, bool goes_on) const;
  void begin(Way& way, FlowProblem& problem) const;
  void end_at(const Way& way, FlowProblem& problem) const;
  Points taken_of_noise(FlowProblem& problem);
  double trace_by_second_flow(const Points& end, const Points& normals) const;
  double trace_by_law(double cutoff) const;
  bool falls_by_law(double cutoff, double trace) const;

  const Topology& topology_;
  const std::vector<std::uint8_t>& held_;
  const double mean_edge_;
  FlowOptions options_;  // to the cut-off
  FlowOptions leg_;      // from the one before to it
  Unknowns unknowns_;
  std::vector<Index> counted_;  // among the unknowns
  Points white_noise_;  // #unknowns x 3: three at once take little longer to smooth than one
  Points smooth_;       // what the flow has left of it
  Way mesh_, moved_;    // the second one by a little of the white noise, where needed
  double time_ = 0;     // at which they are
  std::vector<Outcome> outcomes_;
  bool trace_falls_ = false;  // by the law
  double noise_;
  bool knows_noise_;
};

}  // namespace ibmfair
