// The loops of conjugate gradients over a range of the unknowns, each of which has four float32
// numbers (solve/jacobian_rows.h). Sums are formed in double precision, in an order that depends on
// the range only.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Rows of a matrix in difference form. The i-th row, of unknown u, is (J x)_u = b_f x_u + sum_k
/// b_k (x_column[k] - x_u), where f = first[i] and k runs from f + 1 to first[i + 1] - 1, an even
/// number of entries.
struct DifferenceRows {
  const std::int64_t* first;
  const Index* column;
  const float* b;
};

/// Unknowns begin .. end - 1.
struct UnknownRange {
  std::int64_t begin, end;
};

/// q = J p for the rows of the range; J.first points to the first of them. Returns <p, q>.
double multiply_rows(const DifferenceRows& J, const float* p, float* q, UnknownRange range);

/// r -= alpha q. Returns <r, N r>, where N has one number for each unknown.
double step_residual(float alpha, const float* q, const float* N, float* r, UnknownRange range);

/// x += alpha p, then p = N r + beta p.
void step_solution(float alpha, float beta, const float* r, const float* N, float* x, float* p,
                   UnknownRange range);

}  // namespace ibmfair
