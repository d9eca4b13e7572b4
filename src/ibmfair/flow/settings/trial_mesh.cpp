#include "ibmfair/flow/settings/trial_mesh.h"

#include <algorithm>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/settings/choice_tuning.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {

TrialMesh::TrialMesh(const Points& X, const Topology& topology,
                     const std::vector<std::uint8_t>& fixed, const FlowOptions& options,
                     const SampleSize& sample)
    : X_(X),
      topology_(topology),
      fixed_(fixed),
      options_(options),
      mean_edge_length_(ibmfair::mean_edge_length(X, topology.E)) {
  options_.keep_volume = options_.keep_area = false;
  if (std::count(fixed.begin(), fixed.end(), 0) >
      choice_tuning.cutoff.many_more * sample.vertices) {
    take_sample(sample);
  }
  if (!local_ && is_scattered(topology)) {
    local_ = local_mesh(X, topology, fixed, options_);
  }
}

FlowOptions TrialMesh::here(FlowOptions other) const {
  other.keep_volume = other.keep_area = false;
  other.cutoff_factor = options().cutoff_factor;
  other.spontaneous_curvature = options().spontaneous_curvature;
  other.material_directions = options().material_directions;
  return other;
}

void TrialMesh::take_sample(const SampleSize& size) {
  MeshSample sample = sample_of_mesh(X_, topology_, fixed_, options_, size);
  const auto inner = std::count(sample.inner.begin(), sample.inner.end(), 1);
  if (static_cast<double>(inner) <= choice_tuning.cutoff.least_inner * size.vertices) {
    return;
  }
  if (is_scattered(sample.mesh.topology)) {
    const LocalMesh& s = sample.mesh;
    local_ = local_mesh(s.X, s.topology, s.fixed, s.options);
    for (const Index v : local_->vertex) {
      counted_.push_back(sample.inner[v]);
    }
  } else {
    local_ = std::move(sample.mesh);
    counted_ = std::move(sample.inner);
  }
}

std::vector<Index> counted_unknowns(const TrialMesh& mesh, const Unknowns& unknowns) {
  const auto& counted = mesh.counted();
  std::vector<Index> found = indices_where(unknowns.size(), [&](Index u) {
    return counted.empty() || counted[unknowns.vertex[u]] != 0;
  });
  if (found.empty()) {
    throw BadMesh("no cut-off can be chosen, because no vertex is free to move");
  }
  return found;
}

}  // namespace ibmfair
