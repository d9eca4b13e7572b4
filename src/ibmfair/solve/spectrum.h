// The ends of the spectrum of the pointwise Laplacian M^-1 L of a mesh.
#pragma once

#include <optional>

#include "ibmfair/energy/laplacian_matrices.h"

namespace ibmfair {

struct SpectrumEnds {
  Index nodes = 0;
  Index zeros = 0;  ///< eigenvalues that are zero: parts that L joins, not counted by their size
  /// Smallest other one and largest one: 1/length^2, or dimensionless where M is the identity.
  /// Absent where there is none, where the search for it does not converge, and the smallest one
  /// also where L is not positive semi-definite.
  std::optional<double> smallest, largest;
};

/// Solves L u = lambda M u for both ends by Lanczos' method (Spectra), to some 10 digits; shifted
/// and inverted by one Cholesky factorization for the small end. Throws OutOfMemory.
SpectrumEnds spectrum_ends(const LaplacianMatrices& matrices);

}  // namespace ibmfair
