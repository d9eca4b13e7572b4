// Sparse Cholesky factorization by CHOLMOD [Y. Chen, T. Davis, W. Hager, S. Rajamanickam,
// "Algorithm 887: CHOLMOD, supernodal sparse Cholesky factorization and update/downdate", ACM TOMS
// 35 (2008)]: its own analysis, supernodal L L^T and solves, in float64.
#pragma once

#include <memory>

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/base/types.h"
#include "ibmfair/solve/cholesky.h"
#include "ibmfair/solve/ordering.h"

namespace ibmfair {

class CholmodCholesky {
 public:
  /// Analyses the pattern of `J` for unknowns on a surface, with the positions `X` (#unknowns x 3).
  /// CHOLMOD is given the order of elimination_order(). With METIS, which it would otherwise call,
  /// the factor has a tenth fewer entries, but the analysis takes five times as long
  /// (tools/ordering_table). Throws BadOption if CHOLMOD cannot be loaded, and OutOfMemory.
  CholmodCholesky(const SymmetricMatrix& J, const Points& X);

  /// Analyses the pattern with another order; throws as above.
  CholmodCholesky(const SymmetricMatrix& J, const EliminationOrder& order);
  ~CholmodCholesky();
  CholmodCholesky(CholmodCholesky&&) noexcept;
  CholmodCholesky& operator=(CholmodCholesky&&) noexcept;

  const FactorForecast& forecast() const { return forecast_; }

  /// Factors `J`, symmetric positive definite with the analysed pattern. May be called again with
  /// other values. Throws OutOfMemory, or FactorizationFailed, which names the first unknown in
  /// elimination order at which `J` is not positive definite; the factor can then not be used for
  /// solving.
  void factor(const SymmetricMatrix& J);

  /// Y = J^-1 B, where B has a row for each unknown and three columns. Y may be B.
  void solve(const Points& B, Points& Y);

 private:
  struct State;
  std::unique_ptr<State> state_;
  FactorForecast forecast_;
};

}  // namespace ibmfair
