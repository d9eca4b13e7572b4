#include "ibmfair/flow/jacobian.h"

#include <cmath>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The largest relative residual of a solve. Refining once would leave its square.
constexpr double good_enough = 1e-3;

/// |B - J Y| / |B| in the norm of D^-1, D being the diagonal of J: every row counts alike, however
/// small its triangles are.
double relative_residual(const SymmetricMatrix& J, const Points& Y, const Points& B) {
  const Points R = B - multiply(J, Y);
  double residual = 0, size = 0;
  for (Index i = 0; i < R.rows(); ++i) {
    const double diagonal = J.value[J.column_first[i]];
    residual += R.row(i).squaredNorm() / diagonal;
    size += B.row(i).squaredNorm() / diagonal;
  }
  return size > 0 ? std::sqrt(residual / size) : 0;
}

}  // namespace

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
  }
  h_ = 0;
  factor(precision_);
  h_ = h;
}

void Jacobian::factor(Precision precision) {
  const Stopwatch watch(report_.seconds.factor);
  if (!factor_ || precision != precision_) {
    precision_ = precision;
    solver_.reset();  // refers to the factor
    factor_.emplace(*symbolic_, precision);
    solver_.emplace(*factor_);
  }
  ++report_.factorizations;
  tried_ = precision == Precision::float64;
  try {
    factor_->factor(J_);
  } catch (const FactorizationFailed&) {
    if (precision == Precision::float64) throw;
    factor(Precision::float64);
  }
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
  Points solution;
  {
    const Stopwatch watch(report_.seconds.solve);
    solver_->solve(B, solution);
    ++report_.solves;
    tried_ = tried_ || relative_residual(J_, solution, B) < good_enough;
  }
  if (tried_) {
    Y.swap(solution);
  } else {
    factor(Precision::float64);
    solve(B, Y);
  }
}

}  // namespace ibmfair
