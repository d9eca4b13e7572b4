#include "ibmfair/flow/jacobian.h"

#include <string>

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

Jacobian::Jacobian(BendingEnergy& energy, const Topology& topology, const Unknowns& unknowns,
                   const FlowOptions& options, FlowReport& report)
    : energy_(energy),
      topology_(topology),
      unknowns_(unknowns),
      options_(options),
      report_(report),
      D_(Eigen::VectorXd::Ones(unknowns.size())),
      damping_(D_) {}

void Jacobian::refactor(const Points& X, double h, const Points* directions) {
  {
    const Stopwatch watch(report_.seconds.assemble);
    energy_.linearise(X, weights_);
    if (options_.metric == Metric::mass) {
      D_ = lumped_vertex_mass(X, topology_)(unknowns_.vertex);
    } else {
      D_.setOnes();
    }
    D_ = D_.cwiseProduct(damping_);
  }
  const JacobianParts parts{weights_, D_, h, directions};
  if (!solver_) {
    const JacobianShape shape{energy_.stencils(), unknowns_, options_, report_};
    report_.solver = options_.solver == "auto" ? cheaper_backend(shape, parts) : options_.solver;
    solver_ = jacobian_backend(report_.solver).make(shape);
  }
  h_ = 0;
  solver_->update(parts);
  h_ = h;
}

void Jacobian::solve(const Points& B, Points& Y) {
  solver_->solve(B, Y);
  ++report_.solves;
}

}  // namespace ibmfair
