// What the sparse Cholesky factorizations, solve/multifrontal.h and solve/cholmod_cholesky.h, have
// in common.
#pragma once

#include <string_view>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The cost of a factorization, as predicted by the symbolic analysis.
struct FactorForecast {
  std::string_view ordering;  ///< "minimum degree" or "nested dissection"
  double flops = 0;           ///< floating-point operations of one factorization
  double factor_entries = 0;  ///< entries of L
};

/// Throws FactorizationFailed with a message that names `unknown`, at which the matrix is not
/// positive definite.
[[noreturn]] void refuse_indefinite(Index unknown);

}  // namespace ibmfair
