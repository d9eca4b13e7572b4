// The Hessian of a bending energy under isometry, S = sum_s w_s c_s c_s^T ([W07] section 2.3),
// restricted to the unknown vertices: pattern built once, values refilled in place.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/row_sums.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// The lower triangle of a symmetric n x n matrix, compressed by columns, rows sorted, every
/// diagonal entry present and first in its column. Indices are 64 bits wide throughout.
struct SymmetricMatrix {
  std::vector<std::int64_t> column_first{0};  ///< n + 1
  std::vector<std::int64_t> row;
  std::vector<double> value;

  std::int64_t size() const { return static_cast<std::int64_t>(column_first.size()) - 1; }
};

/// J X for X n x 3.
Points multiply(const SymmetricMatrix& J, const Points& X);

/// Assembles S for one set of stencils and unknowns.
class HessianAssembler {
 public:
  /// Refers to the terms.
  HessianAssembler(const StencilTerms& terms, const Unknowns& unknowns);

  /// S with values of zero.
  SymmetricMatrix pattern() const;

  /// Refills the values of `S`, which pattern() made: positive semi-definite, and zero on
  /// constants where no vertex is fixed.
  void assemble(const StencilWeights& weights, SymmetricMatrix& S) const;

 private:
  RowSums sums_;
};

}  // namespace ibmfair
