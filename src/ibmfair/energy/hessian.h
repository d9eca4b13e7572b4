// The Hessian of a bending energy under isometry, S = sum_s w_s c_s c_s^T ([W07] section 2.3),
// restricted to the unknown vertices. Its pattern is built once, and its values are refilled in
// place.
#pragma once

#include "ibmfair/base/symmetric_matrix.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/row_sums.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// Assembles S for one set of stencils and unknowns.
class HessianAssembler {
 public:
  /// Keeps a reference to `terms`.
  HessianAssembler(const StencilTerms& terms, const Unknowns& unknowns);

  /// The pattern of S, with all values zero.
  SymmetricMatrix pattern() const;

  /// Refills the values of `S`, a matrix returned by pattern(). The result is positive
  /// semi-definite; if no vertex is fixed, constants are in its kernel.
  void assemble(const StencilWeights& weights, SymmetricMatrix& S) const;

 private:
  RowSums sums_;
};

}  // namespace ibmfair
