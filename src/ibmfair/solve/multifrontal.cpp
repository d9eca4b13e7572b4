#include "ibmfair/solve/multifrontal.h"

#include <utility>

#include "ibmfair/solve/frontal_factor.h"
#include "ibmfair/solve/ordering.h"
#include "ibmfair/solve/supernodes.h"
#include "ibmfair/solve/symbolic_factor.h"

namespace ibmfair {

struct MultifrontalAnalysis::State {
  Supernodes nodes;
  EliminatedColumns columns;
};

MultifrontalAnalysis::MultifrontalAnalysis(const SymmetricMatrix& J) {
  const CompressedRows graph = graph_of(J);
  take(J, symbolic_factor(graph, minimum_degree(graph)), "minimum degree");
}

MultifrontalAnalysis::MultifrontalAnalysis(const SymmetricMatrix& J, const Points& X) {
  const CompressedRows graph = graph_of(J);
  const EliminationOrder order = elimination_order(graph, X);
  take(J, symbolic_factor(graph, order.unknown), order.method);
}

void MultifrontalAnalysis::take(const SymmetricMatrix& J, SymbolicFactor factor,
                                std::string_view ordering) {
  forecast_ = {ordering, factor.flops, factor.entries};
  auto state = std::make_shared<State>();
  state->nodes = std::move(factor.nodes);
  state->columns = eliminated_columns(J, state->nodes);
  state_ = std::move(state);
}

struct MultifrontalCholesky::State {
  virtual ~State() = default;
  virtual Index factor(const SymmetricMatrix& J) = 0;
  virtual void solve(const Points& B, Points& Y) = 0;
};

template <class Real>
struct MultifrontalCholesky::InPrecision final : State {
  explicit InPrecision(std::shared_ptr<const MultifrontalAnalysis::State> of)
      : analysis(std::move(of)), numbers(analysis->nodes), solver(numbers) {}

  Index factor(const SymmetricMatrix& J) override { return numbers.factor(J, analysis->columns); }
  void solve(const Points& B, Points& Y) override { solver.solve(B, Y); }

  std::shared_ptr<const MultifrontalAnalysis::State> analysis;
  FrontalFactor<Real> numbers;
  FrontalSolver<Real> solver;
};

MultifrontalCholesky::MultifrontalCholesky(const MultifrontalAnalysis& analysis,
                                           Precision precision) {
  if (precision == Precision::float32) {
    state_ = std::make_unique<InPrecision<float>>(analysis.state_);
  } else {
    state_ = std::make_unique<InPrecision<double>>(analysis.state_);
  }
}

MultifrontalCholesky::~MultifrontalCholesky() = default;
MultifrontalCholesky::MultifrontalCholesky(MultifrontalCholesky&&) noexcept = default;
MultifrontalCholesky& MultifrontalCholesky::operator=(MultifrontalCholesky&&) noexcept = default;

void MultifrontalCholesky::factor(const SymmetricMatrix& J) {
  if (const Index unknown = state_->factor(J); unknown >= 0) refuse_indefinite(unknown);
}

void MultifrontalCholesky::solve(const Points& B, Points& Y) {
  state_->solve(B, Y);
}

}  // namespace ibmfair
