#include "ibmfair/flow/stepwise_flow.h"

#include <cmath>
#include <numeric>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/flow_passes.h"
#include "ibmfair/flow/passes/local_mesh.h"
#include "ibmfair/flow/steps/plain_flow.h"

namespace ibmfair {
namespace {

/// The mesh as the flow numbers it.
LocalMesh numbered(const Points& X, const Topology& topology,
                   const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  if (is_scattered(topology)) {
    return local_mesh(X, topology, fixed, options);
  }
  LocalMesh mesh{{}, X, topology, fixed, options};
  mesh.vertex.resize(static_cast<std::size_t>(X.rows()));
  std::iota(mesh.vertex.begin(), mesh.vertex.end(), Index{0});
  return mesh;
}

FlowOptions as_published(FlowOptions options) {
  options.guarded = false;
  options.twicing = 0;
  options.put_back_slides = false;
  return options;
}

}  // namespace

struct StepwiseFlow::Parts {
  const LocalMesh mesh;
  FlowProblem problem;

  explicit Parts(LocalMesh local)
      : mesh(std::move(local)), problem(mesh.X, mesh.topology, mesh.fixed, mesh.options) {}
};

StepwiseFlow::StepwiseFlow(const Points& X, const Topology& topology,
                           const std::vector<std::uint8_t>& fixed, const FlowOptions& options) {
  const FlowOptions published = as_published(options);
  require_usable(X, fixed, published);
  parts_ = std::make_unique<Parts>(numbered(X, topology, fixed, published));
  FlowProblem& problem = parts_->problem;
  if (problem.unknowns.size() == 0) {
    throw BadMesh("no vertex can move: all are fixed or belong to no triangle");
  }
  problem.jacobian().refactor(problem.X, published.total_time / published.steps);
}

StepwiseFlow::~StepwiseFlow() = default;

std::optional<StepRecord> StepwiseFlow::step() {
  return plain_step(parts_->problem);
}

Points StepwiseFlow::positions() const {
  Points X(parts_->problem.X.rows(), 3);
  X(parts_->mesh.vertex, Eigen::all) = parts_->problem.X;
  return X;
}

void StepwiseFlow::move_to(const Points& X) {
  FlowProblem& problem = parts_->problem;
  if (X.rows() != problem.X.rows()) {
    throw BadMesh("the positions are not as many as the vertices of the flow");
  }
  Points Y = X(parts_->mesh.vertex, Eigen::all);
  if (!Y.allFinite() || !std::isfinite(problem.energy_at(Y))) {
    throw BadMesh("the bending energy at the new positions is not finite");
  }
  problem.move_to(Y);
  problem.update_gradient();
  problem.report.energy_after = problem.energy();
}

double StepwiseFlow::time_step() const {
  return parts_->problem.jacobian().time_step();
}

const FlowReport& StepwiseFlow::report() const {
  return parts_->problem.report;
}

}  // namespace ibmfair
