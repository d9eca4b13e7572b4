// Sparse Cholesky factorization by CHOLMOD (supernodal, 64-bit indices), in its three parts:
// analyse once per pattern, factor once per matrix, solve once per step.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

/// The order of elimination: automatic compares the predicted cost of AMD and METIS.
enum class Ordering : std::uint8_t { automatic, amd, metis };

/// What the analysis predicts.
struct FactorForecast {
  std::string_view ordering;  ///< "AMD" or "METIS"
  double flops = 0;           ///< of one factorization
  double factor_entries = 0;  ///< entries of L
};

/// The symbolic analysis of a pattern: fill-reducing order, elimination tree, supernodes.
class SymbolicCholesky {
 public:
  /// Uses the pattern of `J` only. Throws FactorizationFailed or OutOfMemory.
  explicit SymbolicCholesky(const SymmetricMatrix& J, Ordering ordering = Ordering::automatic);
  ~SymbolicCholesky();
  SymbolicCholesky(SymbolicCholesky&&) noexcept;
  SymbolicCholesky& operator=(SymbolicCholesky&&) noexcept;

  const FactorForecast& forecast() const { return forecast_; }

 private:
  friend class CholeskyFactor;
  struct State;
  std::unique_ptr<State> state_;
  FactorForecast forecast_;
};

/// The factor L L^T of a matrix with the analysed pattern.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(const SymbolicCholesky& symbolic);
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
  explicit CholeskySolver(const CholeskyFactor& factor);
  ~CholeskySolver();
  CholeskySolver(CholeskySolver&&) noexcept;
  CholeskySolver& operator=(CholeskySolver&&) noexcept;

  /// Y = J^-1 B for B with a row for each unknown and three columns; Y may be B.
  void solve(const Points& B, Points& Y);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ibmfair
