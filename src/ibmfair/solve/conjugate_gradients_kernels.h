// The loops of conjugate gradients over a range of the unknowns, each of which has four float32
// (solve/jacobian_rows.h). Sums are in double precision, in an order that the range alone decides.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Rows of a matrix as differences: (J x)_u = b_f x_u + sum_k b_k (x_column[k] - x_u) for the i-th
/// of them, where f is first[i], and k the numbers behind it below first[i + 1], even in number.
struct DifferenceRows {
  const std::int64_t* first;
  const Index* column;
  const float* b;
};

/// Unknowns begin .. end - 1.
struct UnknownRange {
  std::int64_t begin, end;
};

/// q = J p, where J has the rows of the range. Returns <p, q>.
double multiply_rows(const DifferenceRows& J, const float* p, float* q, UnknownRange range);

/// r -= alpha q. Returns <r, N r>, N being one number for each unknown.
double step_residual(float alpha, const float* q, const float* N, float* r, UnknownRange range);

/// x += alpha p, then p = N r + beta p.
void step_solution(float alpha, float beta, const float* r, const float* N, float* x, float* p,
                   UnknownRange range);

}  // namespace ibmfair
