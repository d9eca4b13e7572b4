// Dense kernels on one front: the block of a supernode, and four-wide vectors beside it.
#pragma once

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Factors the first `columns` columns of a symmetric front of `rows` rows in place: `block` (lower
/// triangle, column by column, rows x columns) becomes [L11; L21], and L21 L21^T is taken from
/// `update` (lower triangle, side rows - columns). Returns -1, or the first column whose pivot is
/// not positive. Large fronts are shared among threads in pieces of fixed size.
template <class Real>
Index factor_front(Index rows, Index columns, Real* block, Real* update);

/// Forward substitution with one block: W (rows x 4) holds the right-hand side in its first
/// `columns` rows and what is to be added to in the others. W1 <- L11^-1 W1, W2 <- W2 - L21 W1.
template <class Real>
void substitute_forward(const Real* block, Index rows, Index columns, Real* W);

/// Backward substitution: W1 <- L11^-T (W1 - L21^T W2).
template <class Real>
void substitute_backward(const Real* block, Index rows, Index columns, Real* W);

}  // namespace ibmfair
