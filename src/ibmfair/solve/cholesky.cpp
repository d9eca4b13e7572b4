#include "ibmfair/solve/cholesky.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/ordering.h"
#include "ibmfair/solve/supernodes.h"
#include "ibmfair/solve/symbolic_factor.h"

namespace ibmfair {
namespace {

/// The number of unknowns from which on nested dissection takes less time in total. The value was
/// chosen from the output of tools/ordering_table.
constexpr std::int64_t worth_dissecting = 6'000;

}  // namespace

struct SymbolicCholesky::State {
  Supernodes nodes;
  EliminatedColumns columns;
};

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J) {
  const Rows graph = graph_of(J);
  take(J, symbolic_factor(graph, minimum_degree(graph)), "minimum degree");
}

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, const Points& X) {
  const Rows graph = graph_of(J);
  if (J.size() < worth_dissecting) {
    take(J, symbolic_factor(graph, minimum_degree(graph)), "minimum degree");
  } else {
    take(J, symbolic_factor(graph, nested_dissection(graph, X)), "nested dissection");
  }
}

void SymbolicCholesky::take(const SymmetricMatrix& J, SymbolicFactor factor,
                            std::string_view ordering) {
  forecast_ = {ordering, factor.flops, factor.entries};
  auto state = std::make_shared<State>();
  state->nodes = std::move(factor.nodes);
  state->columns = eliminated_columns(J, state->nodes);
  state_ = std::move(state);
}

using SingleFactor = FrontalFactor<float>;
using DoubleFactor = FrontalFactor<double>;

struct CholeskyFactor::State {
  std::shared_ptr<const SymbolicCholesky::State> symbolic;
  std::variant<SingleFactor, DoubleFactor> factor;
};

CholeskyFactor::CholeskyFactor(const SymbolicCholesky& symbolic, Precision precision) {
  const Supernodes& nodes = symbolic.state_->nodes;
  state_ = precision == Precision::float32
               ? std::make_unique<State>(State{symbolic.state_, SingleFactor(nodes)})
               : std::make_unique<State>(State{symbolic.state_, DoubleFactor(nodes)});
}

CholeskyFactor::~CholeskyFactor() = default;
CholeskyFactor::CholeskyFactor(CholeskyFactor&&) noexcept = default;
CholeskyFactor& CholeskyFactor::operator=(CholeskyFactor&&) noexcept = default;

void CholeskyFactor::factor(const SymmetricMatrix& J) {
  const Index unknown = std::visit(
      [&](auto& factor) { return factor.factor(J, state_->symbolic->columns); }, state_->factor);
  if (unknown >= 0) {
    throw FactorizationFailed(fmt::format(
        "the Jacobian is not positive definite at unknown {}: a triangle there has (almost) no "
        "area, or a coordinate is not finite",
        unknown));
  }
}

struct CholeskySolver::State {
  std::variant<FrontalSolver<float>, FrontalSolver<double>> solver;
};

CholeskySolver::CholeskySolver(const CholeskyFactor& factor) {
  const auto& numbers = factor.state_->factor;
  const auto* single = std::get_if<SingleFactor>(&numbers);
  state_ = single != nullptr
               ? std::make_unique<State>(State{FrontalSolver<float>(*single)})
               : std::make_unique<State>(State{FrontalSolver<double>(std::get<1>(numbers))});
}

CholeskySolver::~CholeskySolver() = default;
CholeskySolver::CholeskySolver(CholeskySolver&&) noexcept = default;
CholeskySolver& CholeskySolver::operator=(CholeskySolver&&) noexcept = default;

void CholeskySolver::solve(const Points& B, Points& Y) {
  std::visit([&](auto& solver) { solver.solve(B, Y); }, state_->solver);
}

}  // namespace ibmfair
