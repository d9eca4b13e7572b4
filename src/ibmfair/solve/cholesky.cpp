#include "ibmfair/solve/cholesky.h"

#include <memory>
#include <utility>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/cholmod_context.h"

namespace ibmfair {
namespace {

/// A factor that CHOLMOD allocated, together with the context that frees it.
class OwnedFactor {
 public:
  OwnedFactor(std::shared_ptr<CholmodContext> context, cholmod_factor* factor)
      : context_(std::move(context)), factor_(factor) {}
  ~OwnedFactor() { cholmod_l_free_factor(&factor_, context_->get()); }
  OwnedFactor(const OwnedFactor&) = delete;
  OwnedFactor& operator=(const OwnedFactor&) = delete;

  CholmodContext& context() const { return *context_; }
  const std::shared_ptr<CholmodContext>& shared_context() const { return context_; }
  cholmod_factor* get() const { return factor_; }

 private:
  std::shared_ptr<CholmodContext> context_;
  cholmod_factor* factor_;
};

/// An analysis under one ordering, with its predicted cost.
struct Candidate {
  std::unique_ptr<OwnedFactor> factor;
  FactorForecast forecast;
};

Candidate analyse(const SymmetricMatrix& J, int method) {
  auto context = std::make_shared<CholmodContext>();
  cholmod_common* common = context->get();
  common->nmethods = 1;
  common->method[0].ordering = method;
  common->postorder = 1;
  cholmod_sparse A = view(J);
  cholmod_factor* L = cholmod_l_analyze(&A, common);
  Candidate candidate{std::make_unique<OwnedFactor>(context, L),
                      {method == CHOLMOD_METIS ? "METIS" : "AMD", common->fl, common->lnz}};
  context->check("analysis");
  return candidate;
}

/// METIS costs several times as much as AMD, and repays it only where the factor is expensive:
/// many operations per entry, many entries per entry of the matrix (CHOLMOD's own rule).
bool metis_may_pay(const FactorForecast& amd, const SymmetricMatrix& J) {
  constexpr double operations_per_entry = 500, growth = 5;
  return amd.flops >= operations_per_entry * amd.factor_entries &&
         amd.factor_entries >= growth * static_cast<double>(J.row.size());
}

}  // namespace

struct SymbolicCholesky::State {
  std::unique_ptr<OwnedFactor> factor;
};

SymbolicCholesky::SymbolicCholesky(const SymmetricMatrix& J, Ordering ordering) {
  Candidate best = analyse(J, ordering == Ordering::metis ? CHOLMOD_METIS : CHOLMOD_AMD);
  if (ordering == Ordering::automatic && metis_may_pay(best.forecast, J)) {
    Candidate metis = analyse(J, CHOLMOD_METIS);
    if (metis.forecast.flops < best.forecast.flops) {
      best = std::move(metis);
    }
  }
  forecast_ = best.forecast;
  state_ = std::make_unique<State>(State{std::move(best.factor)});
}

SymbolicCholesky::~SymbolicCholesky() = default;
SymbolicCholesky::SymbolicCholesky(SymbolicCholesky&&) noexcept = default;
SymbolicCholesky& SymbolicCholesky::operator=(SymbolicCholesky&&) noexcept = default;

struct CholeskyFactor::State {
  std::unique_ptr<OwnedFactor> factor;
};

CholeskyFactor::CholeskyFactor(const SymbolicCholesky& symbolic) {
  const OwnedFactor& pattern = *symbolic.state_->factor;
  cholmod_factor* copy = cholmod_l_copy_factor(pattern.get(), pattern.context().get());
  state_ =
      std::make_unique<State>(State{std::make_unique<OwnedFactor>(pattern.shared_context(), copy)});
  pattern.context().check("factorization");
}

CholeskyFactor::~CholeskyFactor() = default;
CholeskyFactor::CholeskyFactor(CholeskyFactor&&) noexcept = default;
CholeskyFactor& CholeskyFactor::operator=(CholeskyFactor&&) noexcept = default;

void CholeskyFactor::factor(const SymmetricMatrix& J) {
  cholmod_sparse A = view(J);
  cholmod_factor* L = state_->factor->get();
  CholmodContext& context = state_->factor->context();
  const SerialRegion serial;
  cholmod_l_factorize(&A, L, context.get());
  const auto* order = static_cast<const std::int64_t*>(L->Perm);
  const bool failed = L->minor < L->n;
  context.check("factorization", failed ? order[L->minor] : -1);
}

struct CholeskySolver::State {
  const OwnedFactor* factor;
  Eigen::Matrix<double, Eigen::Dynamic, 3> B;  // CHOLMOD wants columns
  cholmod_dense* Y = nullptr;                  // the solution and two workspaces
  cholmod_dense* W = nullptr;
  cholmod_dense* E = nullptr;

  explicit State(const OwnedFactor* f) : factor(f) {}
  ~State() {
    for (cholmod_dense** matrix : {&Y, &W, &E}) {
      cholmod_l_free_dense(matrix, factor->context().get());
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

CholeskySolver::CholeskySolver(const CholeskyFactor& factor)
    : state_(std::make_unique<State>(factor.state_->factor.get())) {}

CholeskySolver::~CholeskySolver() = default;
CholeskySolver::CholeskySolver(CholeskySolver&&) noexcept = default;
CholeskySolver& CholeskySolver::operator=(CholeskySolver&&) noexcept = default;

void CholeskySolver::solve(const Points& B, Points& Y) {
  State& s = *state_;
  s.B = B;
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = static_cast<std::size_t>(B.rows());
  rhs.ncol = 3;
  rhs.nzmax = rhs.nrow * rhs.ncol;
  rhs.x = s.B.data();
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  CholmodContext& context = s.factor->context();
  const SerialRegion serial;
  const bool solved = cholmod_l_solve2(CHOLMOD_A, s.factor->get(), &rhs, nullptr, &s.Y, nullptr,
                                       &s.W, &s.E, context.get()) != 0;
  context.check("solve");
  if (!solved) {
    throw FactorizationFailed("the sparse solve failed");
  }
  Y = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3>>(static_cast<const double*>(s.Y->x),
                                                                 B.rows(), 3);
}

}  // namespace ibmfair
