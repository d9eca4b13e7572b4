#include "ibmfair/solve/cholesky.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/cholmod_context.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/ordering.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {
namespace {

/// Unknowns from which on nested dissection takes less time in all. tools/ordering_table prints
/// what it was chosen by.
constexpr std::int64_t worth_dissecting = 6'000;

template <class Value>
std::vector<Value> copy(const void* from, std::size_t count) {
  const auto* first = static_cast<const std::int64_t*>(from);
  return {first, first + count};
}

/// CHOLMOD's symbolic factor.
class Analysis {
 public:
  Analysis(const SymmetricMatrix& J, const std::vector<Index>& order) {
    cholmod_common* common = context_.get();
    common->nmethods = 1;
    common->postorder = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    std::vector<std::int64_t> given(order.begin(), order.end());
    cholmod_sparse A = lower_pattern(J.column_first, J.row);
    factor_ = cholmod_l_analyze_p(&A, given.data(), nullptr, 0, common);
    context_.check("analysis");
  }
  ~Analysis() { cholmod_l_free_factor(&factor_, context_.get()); }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  double flops() { return context_.get()->fl; }
  double factor_entries() { return context_.get()->lnz; }

  Supernodes supernodes() const {
    Supernodes nodes;
    nodes.unknown = copy<Index>(factor_->Perm, factor_->n);
    nodes.first_column = copy<Index>(factor_->super, factor_->nsuper + 1);
    nodes.first_row = copy<std::int64_t>(factor_->pi, factor_->nsuper + 1);
    nodes.row = copy<Index>(factor_->s, factor_->ssize);
    complete(nodes);
    return nodes;
  }

 private:
  CholmodContext context_;
  cholmod_factor* factor_ = nullptr;
};

}  // namespace

struct SymbolicCholesky::State {
  Supernodes nodes;
  EliminatedColumns columns;
};

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J)
    : SymbolicCholesky(J, minimum_degree(graph_of(J)), "minimum degree") {}

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, const Points& X)
    : SymbolicCholesky(
          J.size() < worth_dissecting
              ? SymbolicCholesky(J)
              : SymbolicCholesky(J, nested_dissection(graph_of(J), X), "nested dissection")) {}

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, const std::vector<Index>& order,
                                   std::string_view ordering) {
  Analysis analysis(J, order);
  forecast_ = {ordering, analysis.flops(), analysis.factor_entries()};
  auto state = std::make_shared<State>();
  state->nodes = analysis.supernodes();
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
