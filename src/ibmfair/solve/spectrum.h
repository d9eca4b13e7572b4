// The smallest and the largest eigenvalue of the pointwise Laplacian M^-1 L of a mesh.
#pragma once

#include <optional>

#include "ibmfair/energy/laplacian_matrices.h"

namespace ibmfair {

struct SpectrumEnds {
  Index nodes = 0;
  Index zeros = 0;  ///< multiplicity of the eigenvalue zero: the number of connected components of
                    ///< L's graph, not found by comparing eigenvalues with a threshold
  /// The smallest eigenvalue besides these zeros, and the largest one: 1/length^2, or dimensionless
  /// if M is the identity. An eigenvalue is absent if there is none or if the search for it does
  /// not converge; `smallest` is also absent if L is not positive semi-definite.
  std::optional<double> smallest, largest;
};

/// Solves L u = lambda M u for the smallest and the largest eigenvalue by Lanczos' method
/// (Spectra), to about 10 digits. For the smallest eigenvalue, the method is applied in
/// shift-and-invert mode with one Cholesky factorization. Throws OutOfMemory.
SpectrumEnds spectrum_ends(const LaplacianMatrices& matrices);

}  // namespace ibmfair
