#include "ibmfair/solve/cholesky.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/cholmod_context.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/supernodes.h"

namespace ibmfair {
namespace {

/// Operations an entry of the factor, in the order of minimum degree, from which on nested
/// dissection may pay: it takes three to seven times as long to find, and leaves half the
/// operations at best, for the few factorizations of a flow. Spheres come to that with 60,000
/// unknowns, tori with twice, thin and limbed surfaces with six times as many: above, it is taken
/// for granted.
constexpr double worth_dissecting = 700;
constexpr std::int64_t dissected_at_once = 400'000;

template <class Value>
std::vector<Value> copy(const void* from, std::size_t count) {
  const auto* first = static_cast<const std::int64_t*>(from);
  return {first, first + count};
}

/// CHOLMOD's symbolic factor.
class Analysis {
 public:
  /// In the order given, or by minimum degree where it is empty.
  explicit Analysis(const SymmetricMatrix& J, const std::vector<Index>& order = {}) {
    cholmod_common* common = context_.get();
    common->nmethods = 1;
    common->postorder = 1;
    common->method[0].ordering = order.empty() ? CHOLMOD_AMD : CHOLMOD_GIVEN;
    std::vector<std::int64_t> given(order.begin(), order.end());
    cholmod_sparse A = lower_pattern(J.column_first, J.row);
    factor_ = cholmod_l_analyze_p(&A, given.empty() ? nullptr : given.data(), nullptr, 0, common);
    context_.check("analysis");
    forecast_ = {order.empty() ? "AMD" : "METIS", common->fl, common->lnz};
  }
  ~Analysis() { cholmod_l_free_factor(&factor_, context_.get()); }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const FactorForecast& forecast() const { return forecast_; }

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
  FactorForecast forecast_;
};

/// As asked for, or the one that costs less in all.
std::unique_ptr<const Analysis> analyse(const SymmetricMatrix& J, Ordering ordering) {
  std::unique_ptr<const Analysis> by_degree;
  const bool open = ordering == Ordering::automatic && J.size() < dissected_at_once;
  if (open || ordering == Ordering::amd) {
    by_degree = std::make_unique<Analysis>(J);
    const FactorForecast& forecast = by_degree->forecast();
    if (ordering == Ordering::amd || forecast.flops < worth_dissecting * forecast.factor_entries) {
      return by_degree;
    }
  }
  auto dissected = std::make_unique<const Analysis>(J, nested_dissection(J));
  const bool better = !by_degree || dissected->forecast().flops < by_degree->forecast().flops;
  return better ? std::move(dissected) : std::move(by_degree);
}

}  // namespace

struct SymbolicCholesky::State {
  Supernodes nodes;
  EliminatedColumns columns;
};

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, Ordering ordering) {
  const std::unique_ptr<const Analysis> analysis = analyse(J, ordering);
  forecast_ = analysis->forecast();
  auto state = std::make_shared<State>();
  state->nodes = analysis->supernodes();
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
