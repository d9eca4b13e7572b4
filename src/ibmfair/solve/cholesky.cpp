#include "ibmfair/solve/cholesky.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/blas_memory.h"
#include "ibmfair/solve/cholmod_context.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {
namespace {

/// Below, minimum degree costs less in all; above, nested dissection does.
constexpr std::int64_t small = 4096;

/// Frees CHOLMOD's factor when done.
class Analysis {
 public:
  Analysis(CholmodContext& context, cholmod_factor* factor) : context_(context), factor_(factor) {}
  ~Analysis() { cholmod_l_free_factor(&factor_, context_.get()); }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
  const cholmod_factor* operator->() const { return factor_; }

 private:
  CholmodContext& context_;
  cholmod_factor* factor_;
};

template <class Value>
std::vector<Value> copy(const void* from, std::size_t count) {
  const auto* first = static_cast<const std::int64_t*>(from);
  return {first, first + count};
}

Supernodes supernodes(const SymmetricMatrix& J, Ordering ordering, FactorForecast& forecast) {
  CholmodContext context;
  cholmod_common* common = context.get();
  common->nmethods = 1;
  common->postorder = 1;
  std::vector<std::int64_t> given;
  if (ordering == Ordering::metis) {
    const std::vector<Index> unknown = nested_dissection(J);
    given.assign(unknown.begin(), unknown.end());
  }
  common->method[0].ordering = given.empty() ? CHOLMOD_AMD : CHOLMOD_GIVEN;
  cholmod_sparse A = lower_pattern(J.column_first, J.row);
  const Analysis L(
      context, cholmod_l_analyze_p(&A, given.empty() ? nullptr : given.data(), nullptr, 0, common));
  context.check("analysis");
  forecast = {given.empty() ? "AMD" : "METIS", common->fl, common->lnz};
  Supernodes nodes;
  nodes.unknown = copy<Index>(L->Perm, L->n);
  nodes.first_column = copy<Index>(L->super, L->nsuper + 1);
  nodes.first_row = copy<std::int64_t>(L->pi, L->nsuper + 1);
  nodes.row = copy<Index>(L->s, L->ssize);
  complete(nodes);
  return nodes;
}

}  // namespace

struct SymbolicCholesky::State {
  Supernodes nodes;
  EliminatedColumns columns;
};

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, Ordering ordering) {
  if (ordering == Ordering::automatic) {
    ordering = J.size() < small ? Ordering::amd : Ordering::metis;
  }
  auto state = std::make_shared<State>();
  state->nodes = supernodes(J, ordering, forecast_);
  state->columns = eliminated_columns(J, state->nodes.unknown);
  state_ = std::move(state);
}

using SingleFactor = FrontalFactor<float>;
using DoubleFactor = FrontalFactor<double>;

struct CholeskyFactor::State {
  std::shared_ptr<const SymbolicCholesky::State> symbolic;
  std::variant<SingleFactor, DoubleFactor> factor;
};

CholeskyFactor::CholeskyFactor(const SymbolicCholesky& symbolic, Precision precision) {
  reserve_blas_memory();
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
