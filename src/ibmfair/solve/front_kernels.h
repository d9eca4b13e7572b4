// Dense kernels on one front: the block of a supernode, and four-wide vectors beside it.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Factors the first `columns` columns of a symmetric front of `rows` rows in place: `block` (lower
/// triangle, column by column, rows x columns) becomes [L11; L21], and L21 L21^T is taken from
/// `update` (lower triangle, side rows - columns). Returns -1, or the first column whose pivot is
/// not positive. Large fronts are shared among threads in pieces of fixed size.
template <class Real>
Index factor_front(Index rows, Index columns, Real* block, Real* update);

/// Substitution reads every entry of a factor once in either direction, and is bound by that. It
/// gets the entries in the order in which it takes them, which the processor foresees: in panels of
/// four columns (the last one of as many as are left), row by row from the panel's first one on.
constexpr Index panel_width = 4;

/// The numbers in all panels of a front, `columns` of whose rows are its own.
constexpr std::int64_t packed_size(Index rows, Index columns) {
  const std::int64_t full = columns / panel_width, rest = columns % panel_width;
  return full * panel_width * (rows - panel_width * (full - 1) / 2) +
         rest * (rows - panel_width * full);
}

/// The first `columns` columns of a factored front (rows x columns, column by column), in panels.
template <class Real>
void pack_front(const Real* block, Index rows, Index columns, Real* packed);

/// Forward substitution with one front in panels: W (rows x 4) holds the right-hand side in its
/// first `columns` rows and what is to be added to in the others. W1 <- L11^-1 W1,
/// W2 <- W2 - L21 W1.
template <class Real>
void substitute_forward(const Real* packed, Index rows, Index columns, Real* W);

/// Backward substitution: W1 <- L11^-T (W1 - L21^T W2). Takes the panels from their end.
template <class Real>
void substitute_backward(const Real* packed, Index rows, Index columns, Real* W);

}  // namespace ibmfair
