// The two energies that the vectorized kernels compute, once more as plain sums over stencils: the
// oracle for energy/lagrange_kernels.h and energy/crouzeix_raviart_kernels.h.
#pragma once

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"

namespace ibmfair::test {

struct PlainEnergy {
  double E = 0;
  Points G;  ///< the gradient, #V x 3
};

/// The sum over stars, each a vertex v and then its ring in cyclic order ([W07] section 2.2 and,
/// for H0, section 4; energy/lagrange.h). H0 has one number per vertex, or none.
PlainEnergy plain_lagrange(const CompressedRows& stars, const Points& X, bool mass,
                           const PerVertex& H0 = {});

/// The sum over hinges x0, x1 (edge), x2, x3 ([W07] Theorem 3; energy/crouzeix_raviart.h).
/// `inverse_bound` is 1 / u0, or 0 for no bound.
PlainEnergy plain_crouzeix_raviart(const CompressedRows& hinges, const Points& X, bool mass,
                                   double inverse_bound = 0);

}  // namespace ibmfair::test
