// The mesh on which settings are tried: the mesh itself, a renumbered copy if that is faster, or a
// sample of a large mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ibmfair/energy/unknowns.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/settings/sample_of_mesh.h"

namespace ibmfair {

class TrialMesh {
 public:
  /// The mesh and `fixed` must outlive this object. Large meshes are sampled, unless they are in so
  /// small pieces that the sample would consist mostly of rims. Neither volume nor area are kept in
  /// trials.
  TrialMesh(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
            const FlowOptions& options, const SampleSize& sample);

  const Points& X() const { return local_ ? local_->X : X_; }
  const Topology& topology() const { return local_ ? local_->topology : topology_; }
  const std::vector<std::uint8_t>& fixed() const { return local_ ? local_->fixed : fixed_; }
  const FlowOptions& options() const { return local_ ? local_->options : options_; }
  /// Options of another flow of the same mesh, with the lists of this one in place of its own.
  FlowOptions here(FlowOptions other) const;
  /// Flags of the vertices that count, #V, or empty for all.
  const std::vector<std::uint8_t>& counted() const { return counted_; }
  /// Of the whole mesh, length.
  double mean_edge_length() const { return mean_edge_length_; }

 private:
  void take_sample(const SampleSize& size);

  const Points& X_;
  const Topology& topology_;
  const std::vector<std::uint8_t>& fixed_;
  FlowOptions options_;
  const double mean_edge_length_;
  std::optional<LocalMesh> local_;
  std::vector<std::uint8_t> counted_;
};

/// The unknowns of the mesh whose vertices are counted. Throws BadMesh if there is none.
std::vector<Index> counted_unknowns(const TrialMesh& mesh, const Unknowns& unknowns);

}  // namespace ibmfair
