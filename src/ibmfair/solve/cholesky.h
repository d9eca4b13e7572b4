// Sparse Cholesky factorization in three phases: analyse once per pattern, factor once per matrix,
// solve once per step. CHOLMOD does the symbolic analysis; the numerical factorization and the
// solves use the multifrontal method (solve/multifrontal.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair {

struct SymbolicFactor;

/// The cost of a factorization, as predicted by the symbolic analysis.
struct FactorForecast {
  std::string_view ordering;  ///< "minimum degree" or "nested dissection"
  double flops = 0;           ///< floating-point operations of one factorization
  double factor_entries = 0;  ///< entries of L
};

/// The symbolic analysis of a pattern: fill-reducing elimination order, elimination tree,
/// supernodes.
class SymbolicCholesky {
 public:
  /// Uses minimum degree. Depends on the pattern of `J` only, not on its values. Throws
  /// FactorizationFailed or OutOfMemory.
  explicit SymbolicCholesky(const SymmetricMatrix& J);

  /// Analyses J for unknowns on a surface, with the positions `X` (#unknowns x 3). If there are
  /// many unknowns, they are ordered by nested dissection based on their positions, which gives
  /// less fill-in and runs on all threads.
  SymbolicCholesky(const SymmetricMatrix& J, const Points& X);

  const FactorForecast& forecast() const { return forecast_; }

 private:
  void take(const SymmetricMatrix& J, SymbolicFactor factor, std::string_view ordering);

  friend class CholeskyFactor;
  struct State;
  std::shared_ptr<const State> state_;  // shared: CholeskyFactor objects keep it alive
  FactorForecast forecast_;
};

/// The precision of the numbers in a factor. In float32, half as many bytes are read and the
/// multiplications take about half the time. This precision suffices for a Jacobian that is inexact
/// by design as long as the condition number is below about 1e6.
enum class Precision : std::uint8_t { float32, float64 };

/// The factor L L^T of a matrix with the analysed pattern.
class CholeskyFactor {
 public:
  explicit CholeskyFactor(const SymbolicCholesky& symbolic,
                          Precision precision = Precision::float64);
  ~CholeskyFactor();
  CholeskyFactor(CholeskyFactor&&) noexcept;
  CholeskyFactor& operator=(CholeskyFactor&&) noexcept;

  /// Factors `J`, symmetric positive definite with the analysed pattern. May be called again with
  /// other values. Throws OutOfMemory, or FactorizationFailed, which names the unknown at which `J`
  /// is not positive definite; the factor can then not be used for solving.
  void factor(const SymmetricMatrix& J);

 private:
  friend class CholeskySolver;
  struct State;
  std::unique_ptr<State> state_;
};

/// Solves with one factor for three right-hand sides at a time. Workspaces are reused between
/// solves.
class CholeskySolver {
 public:
  /// Keeps a reference to `factor`.
  explicit CholeskySolver(const CholeskyFactor& factor);
  ~CholeskySolver();
  CholeskySolver(CholeskySolver&&) noexcept;
  CholeskySolver& operator=(CholeskySolver&&) noexcept;

  /// Y = J^-1 B, where B has a row for each unknown and three columns. Y may be B. The result is
  /// bit-identical for any number of threads.
  void solve(const Points& B, Points& Y);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ibmfair
