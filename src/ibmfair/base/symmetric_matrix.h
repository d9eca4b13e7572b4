// Sparse symmetric matrices.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The lower triangle of a symmetric n x n matrix in compressed column format. The rows of a column
/// are sorted; every diagonal entry is present and is the first in its column. All indices have 64
/// bits.
struct SymmetricMatrix {
  std::vector<std::int64_t> column_first{0};  ///< n + 1
  std::vector<std::int64_t> row;
  std::vector<double> value;

  std::int64_t size() const { return static_cast<std::int64_t>(column_first.size()) - 1; }
};

/// J X for X n x 3.
inline Points multiply(const SymmetricMatrix& J, const Points& X) {
  Points Y = Points::Zero(X.rows(), 3);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    const std::int64_t diagonal = J.column_first[j];
    const Vec3 x = X.row(j);
    Vec3 y = J.value[diagonal] * x;  // in registers
    for (std::int64_t k = diagonal + 1; k < J.column_first[j + 1]; ++k) {
      Y.row(J.row[k]) += J.value[k] * x;
      y += J.value[k] * X.row(J.row[k]);
    }
    Y.row(j) += y;
  }
  return Y;
}

}  // namespace ibmfair
