// Sparse Cholesky factorization in its three parts: analyse once per pattern, factor once per
// matrix, solve once per step. CHOLMOD analyses; the numbers are computed and used by the
// multifrontal method (solve/multifrontal.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

struct SymbolicFactor;

/// What the analysis predicts.
struct FactorForecast {
  std::string_view ordering;  ///< "minimum degree" or "nested dissection"
  double flops = 0;           ///< of one factorization
  double factor_entries = 0;  ///< entries of L
};

/// The symbolic analysis of a pattern: fill-reducing order, elimination tree, supernodes.
class SymbolicCholesky {
 public:
  /// Depends on the pattern of `J` only, not on its values. Throws FactorizationFailed or
  /// OutOfMemory.
  explicit SymbolicCholesky(const SymmetricMatrix& J);

  /// Analyses J for unknowns on a surface, at `X` (#unknowns x 3): many are put in order by where
  /// they lie, which leaves a smaller factor, and is found on all threads.
  SymbolicCholesky(const SymmetricMatrix& J, const Points& X);

  const FactorForecast& forecast() const { return forecast_; }

 private:
  void take(const SymmetricMatrix& J, SymbolicFactor factor, std::string_view ordering);

  friend class CholeskyFactor;
  struct State;
  std::shared_ptr<const State> state_;  // factors keep it alive
  FactorForecast forecast_;
};

/// Of the numbers in a factor. Half as many bytes are read and multiplied in about half the time:
/// enough for a Jacobian that is inexact by design, while its condition number is below about 1e6.
enum class Precision : std::uint8_t { float32, float64 };

/// The factor L L^T of a matrix with the analysed pattern.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(const SymbolicCholesky& symbolic,
                          Precision precision = Precision::float64);
  ~CholeskyFactor();
  CholeskyFactor(CholeskyFactor&&) noexcept;
  CholeskyFactor& operator=(CholeskyFactor&&) noexcept;

  /// Factors `J`, symmetric positive definite with the analysed pattern; may be called again for
  /// other values. Throws FactorizationFailed, naming the unknown at which `J` is not positive
  /// definite, or OutOfMemory; the factor can then not be used for solving.
  void factor(const SymmetricMatrix& J);

 private:
  friend class CholeskySolver;
  struct State;
  std::unique_ptr<State> state_;
};

/// Solves with one factor, three right-hand sides at a time, in workspaces that are kept.
class CholeskySolver {
 public:
  /// Refers to the factor.
  explicit CholeskySolver(const CholeskyFactor& factor);
  ~CholeskySolver();
  CholeskySolver(CholeskySolver&&) noexcept;
  CholeskySolver& operator=(CholeskySolver&&) noexcept;

  /// Y = J^-1 B for B with a row for each unknown and three columns; Y may be B. The same bytes
  /// for any number of threads.
  void solve(const Points& B, Points& Y);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ibmfair
