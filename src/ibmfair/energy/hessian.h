// The Hessian of a bending energy under isometry, S = sum_s w_s c_s c_s^T ([W07] section 2.3),
// restricted to the unknown vertices: pattern built once, values refilled in place.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/stencil_terms.h"

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

/// Numbers the vertices that are solved for.
struct Unknowns {
  std::vector<Index> vertex;  ///< the vertex of each unknown, in increasing order
  /// #V, the unknown of each vertex, or -1 where it is held fixed. Numbers from size() on are those
  /// of vertices that belong to other parts of the mesh (flow/mesh_parts.h).
  std::vector<Index> unknown;

  Unknowns() = default;
  /// `own`: #V, or empty for all, which vertices belong to this part; these come first.
  explicit Unknowns(const std::vector<std::uint8_t>& fixed,
                    const std::vector<std::uint8_t>& own = {});
  Index size() const { return static_cast<Index>(vertex.size()); }
};

/// Assembles S for one set of stencils and unknowns.
class HessianAssembler {
 public:
  /// Refers to the terms.
  HessianAssembler(const StencilTerms& terms, const Unknowns& unknowns);

  /// The pattern with zero values.
  const SymmetricMatrix& pattern() const { return pattern_; }

  /// Refills the values of `S`, which has this pattern: positive semi-definite, and zero on
  /// constants where no vertex is fixed.
  void assemble(const StencilWeights& weights, SymmetricMatrix& S) const;

 private:
  void find_pattern(const std::vector<Index>& unknown);

  const StencilTerms& terms_;
  std::vector<Index> vertex_;  // of each unknown
  SymmetricMatrix pattern_;
};

}  // namespace ibmfair
