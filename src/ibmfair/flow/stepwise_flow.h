// The flow as published ([W07] section 3.2), one step at a time, with one factorization for all
// steps: for callers that look at every state, or that run the flow again from other positions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Must not be used by two threads at the same time.
class StepwiseFlow {
 public:
  /// Analyses and factors J = D + h S(X), with the time step h = total_time / steps. `X`: #V x 3;
  /// vertices with `fixed[v]` set (#V) are fixed. Twicing, relaxation, the first stage and the
  /// clean-up are left out, as in a flow that is not guarded. Throws like willmore_flow, and
  /// BadMesh if no vertex can move.
  StepwiseFlow(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
               const FlowOptions& options);
  ~StepwiseFlow();
  StepwiseFlow(const StepwiseFlow&) = delete;
  StepwiseFlow& operator=(const StepwiseFlow&) = delete;

  /// Makes one step. Returns nothing, and keeps the state, if the energy would no longer be finite.
  std::optional<StepRecord> step();

  /// The positions, #V x 3, numbered as those in the constructor.
  Points positions() const;

  /// Continues from other positions, #V x 3, with the same factorization; fixed vertices take
  /// theirs, too. This is the same flow as long as the triangles have nearly the same edge lengths
  /// as those in the constructor; otherwise the steps are still downhill, but of another length.
  /// Throws BadMesh if the energy there is not finite.
  void move_to(const Points& X);

  double time_step() const;  ///< in the flow's unit

  /// All steps so far; `energy_after` is E_b at the state.
  const FlowReport& report() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ibmfair
