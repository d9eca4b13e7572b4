// Dense kernels on one front: the block of a supernode, and vectors beside it.
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

// Substitution reads every entry of a factor once in either direction, and is bound by that. It
// gets the entries in the order in which it takes them, which the processor foresees, and as many
// rows at a time as fill 32 bytes:
//
// - Rows 0 .. w - 1, w .. 2 w - 1, and so on make packs, the last one filled up with zeros. As many
//   columns make a chunk; the last one may have fewer.
// - A chunk begins with its rows of the same numbers. They are kept as the inverse of the matrix
//   that they make when columns of the identity are put beside them, less the identity, column by
//   column: substitution in them is a product with it, in which nothing waits for anything.
// - Panels of four columns follow, and one of those that are left: pack by pack, from the one below
//   the chunk on, column by column in each.

/// Rows of a pack, columns of a chunk.
template <class Real>
constexpr Index pack_rows = 32 / sizeof(Real);
constexpr Index panel_width = 4;

template <class Real>
constexpr Index packs_of(Index rows) {
  return (rows + pack_rows<Real> - 1) / pack_rows<Real>;
}

/// The numbers of the first `columns` columns of a front, its own, in that order.
template <class Real>
constexpr std::int64_t packed_size(Index rows, Index columns) {
  constexpr std::int64_t pack = pack_rows<Real>;
  const std::int64_t packs = packs_of<Real>(rows), full = columns / pack, rest = columns % pack;
  return pack * (pack * (full * packs - full * (full - 1) / 2) + rest * (packs - full));
}

/// The numbers that substitution with a front of so many rows needs to work in.
template <class Real>
constexpr std::int64_t workspace_size(Index rows) {
  return 3 * std::int64_t{pack_rows<Real>} * packs_of<Real>(rows);
}

/// The first `columns` columns of a factored front (rows x columns, column by column), in packs.
template <class Real>
void pack_front(const Real* block, Index rows, Index columns, Real* packed);

/// Forward substitution with one packed front. `front` (rows x 4) holds the right-hand side in its
/// first `columns` rows, W1, and what is to be added to in the others, W2. Puts L11^-1 W1 into
/// `own` (columns x 4) and W2 - L21 L11^-1 W1 into `below` ((rows - columns) x 4).
template <class Real>
void substitute_forward(const Real* packed, Index rows, Index columns, const Real* front, Real* own,
                        Real* below, Real* workspace);

/// Backward substitution: of the rows of x (n x 4) that `row` (#rows) names, the first `columns`,
/// which follow each other, become L11^-T (W1 - L21^T W2). Takes the packed numbers from their end.
template <class Real>
void substitute_backward(const Real* packed, Index rows, Index columns, const Index* row, Real* x,
                         Real* workspace);

}  // namespace ibmfair
