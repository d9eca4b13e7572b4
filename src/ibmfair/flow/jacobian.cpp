#include "ibmfair/flow/jacobian.h"

#include "ibmfair/base/parallel.h"
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
      assembler_(energy.stencils(), unknowns),
      J_(assembler_.pattern()),
      D_(Eigen::VectorXd::Ones(unknowns.size())),
      damping_(D_) {}

void Jacobian::refactor(const Points& X, double h, const Points* directions) {
  {
    const Stopwatch watch(report_.seconds.assemble);
    energy_.linearise(X, weights_);
    assembler_.assemble(weights_, J_);
    if (options_.metric == Metric::mass) {
      D_ = lumped_vertex_mass(X, topology_)(unknowns_.vertex);
    } else {
      D_.setOnes();
    }
    D_ = D_.cwiseProduct(damping_);
    for (double& entry : J_.value) {
      entry *= h;
    }
    for (Index u = 0; u < unknowns_.size(); ++u) {
      J_.value[J_.column_first[u]] += D_[u];
    }
    if (directions != nullptr) {
      restrict_to(*directions);
    }
  }
  if (!symbolic_) {
    const Stopwatch watch(report_.seconds.analyse);
    symbolic_.emplace(J_, options_.ordering);
    report_.forecast = symbolic_->forecast();
    factor_.emplace(*symbolic_);
    solver_.emplace(*factor_);
  }
  const Stopwatch watch(report_.seconds.factor);
  h_ = 0;
  factor_->factor(J_);
  h_ = h;
  ++report_.factorizations;
}

void Jacobian::restrict_to(const Points& directions) {
  parallel_for(J_.size(), [&](std::int64_t j) {
    // The diagonal comes first, and stays: where a direction is zero, it keeps J definite.
    for (std::int64_t k = J_.column_first[j] + 1; k < J_.column_first[j + 1]; ++k) {
      J_.value[k] *= directions.row(j).dot(directions.row(J_.row[k]));
    }
  });
}

void Jacobian::solve(const Points& B, Points& Y) {
  const Stopwatch watch(report_.seconds.solve);
  solver_->solve(B, Y);
  ++report_.solves;
}

}  // namespace ibmfair
