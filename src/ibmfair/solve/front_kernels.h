// Dense kernels on one front: the block of a supernode, and vectors beside it.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"
#include "ibmfair/solve/front_layout.h"

namespace ibmfair {

/// Factors the own columns of a symmetric front in place: `block` becomes [L11; L21], and `update`
/// -L21 L21^T, whatever was there. Rows of the last pack that the front does not have must be zero.
/// Returns -1, or the first column whose pivot is not positive. Large fronts are shared among
/// threads; the bytes do not depend on their number.
template <class Real>
Index factor_front(const FrontLayout<Real>& front, Real* block, Real* update);

/// Adds what a child's update has in that part of its parent's front. `place` says which of the
/// parent's rows each of the child's rows below its own is; it increases.
template <class Real>
void add_update(const FrontLayout<Real>& child, const Real* update, const FrontLayout<Real>& parent,
                const Index* place, FrontPart part, Real* numbers);

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

/// The block of a factored front in that order.
template <class Real>
void pack_front(const FrontLayout<Real>& front, const Real* block, Real* packed);

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
