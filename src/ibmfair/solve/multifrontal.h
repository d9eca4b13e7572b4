// Sparse Cholesky factorization by the multifrontal method, in three phases: analyse once per
// pattern, factor once per matrix, solve once per step.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/base/types.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

struct SymbolicFactor;

/// The symbolic analysis of a pattern: fill-reducing elimination order, elimination tree,
/// supernodes.
class MultifrontalAnalysis {
 public:
  /// Orders by minimum degree. Depends on the pattern of `J` only, not on its values. Throws
  /// OutOfMemory.
  explicit MultifrontalAnalysis(const SymmetricMatrix& J);

  /// Analyses J for unknowns on a surface, with the positions `X` (#unknowns x 3), which
  /// elimination_order() uses.
  MultifrontalAnalysis(const SymmetricMatrix& J, const Points& X);

  const FactorForecast& forecast() const { return forecast_; }

 private:
  void take(const SymmetricMatrix& J, SymbolicFactor factor, std::string_view ordering);

  friend class MultifrontalCholesky;
  struct State;
  std::shared_ptr<const State> state_;  // shared: MultifrontalCholesky objects keep it alive
  FactorForecast forecast_;
};

/// The precision of the numbers in a factor. In float32, half as many bytes are read and the
/// multiplications take about half the time. This precision suffices for a Jacobian that is inexact
/// by design as long as the condition number is below about 1e6.
enum class Precision : std::uint8_t { float32, float64 };

/// The factor L L^T of a matrix with the analysed pattern, with workspaces for solving.
class MultifrontalCholesky {
 public:
  explicit MultifrontalCholesky(const MultifrontalAnalysis& analysis,
                                Precision precision = Precision::float64);
  ~MultifrontalCholesky();
  MultifrontalCholesky(MultifrontalCholesky&&) noexcept;
  MultifrontalCholesky& operator=(MultifrontalCholesky&&) noexcept;

  /// Factors `J`, symmetric positive definite with the analysed pattern. May be called again with
  /// other values. Throws OutOfMemory, or FactorizationFailed, which names the first unknown in
  /// elimination order at which `J` is not positive definite; the factor can then not be used for
  /// solving.
  void factor(const SymmetricMatrix& J);

  /// Y = J^-1 B, where B has a row for each unknown and three columns. Y may be B. The result is
  /// bit-identical for any number of threads.
  void solve(const Points& B, Points& Y);

 private:
  struct State;
  template <class Real>
  struct InPrecision;
  std::unique_ptr<State> state_;
};

}  // namespace ibmfair
