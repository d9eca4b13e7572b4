// Dense kernels on one front, the dense matrix of a supernode, and on vectors of as many rows.
#pragma once

#include <cstdint>

#include "ibmfair/base/types.h"
#include "ibmfair/solve/front_layout.h"

namespace ibmfair {

/// Factors the own columns of a symmetric front in place: `block` becomes [L11; L21], and `update`
/// is overwritten with -L21 L21^T. In the last pack, rows beyond those of the front must be zero.
/// Returns -1, or the first column whose pivot is not positive. Large fronts are shared among
/// threads; the result is bit-identical for any number of threads.
template <class Real>
Index factor_front(const FrontLayout<Real>& front, Real* block, Real* update);

/// Adds a child's update to the given part of its parent's front. `place` maps each of the child's
/// rows below its own to a row of the parent; it is increasing.
template <class Real>
void add_update(const FrontLayout<Real>& child, const Real* update, const FrontLayout<Real>& parent,
                const Index* place, FrontPart part, Real* numbers);

// Substitution reads every entry of a factor once in each direction, and memory bandwidth limits
// its speed. The entries are therefore stored in the order in which substitution reads them, which
// the hardware can prefetch, and in as many rows at a time as fill 32 bytes:
//
// - Rows 0 .. w - 1, w .. 2 w - 1, and so on form packs; the last pack is padded with zeros. Each w
//   columns form a chunk; the last chunk may have fewer.
// - A chunk begins with its diagonal pack, the rows with the same numbers as its columns. If the
//   chunk has fewer than w columns, these rows are completed to a square matrix with columns of the
//   identity. Stored is the inverse of this matrix minus the identity, column by column:
//   substitution in the chunk is then a matrix product, which has no dependency chain.
// - Panels of four columns follow, and one panel of the columns that remain. Each panel is stored
//   pack by pack from the pack below the chunk on, and column by column within a pack.

/// The number of stored values of the first `columns` own columns of a front in this order.
template <class Real>
constexpr std::int64_t packed_size(Index rows, Index columns) {
  constexpr std::int64_t pack = pack_rows<Real>;
  const std::int64_t packs = packs_of<Real>(rows), full = columns / pack, rest = columns % pack;
  return pack * (pack * (full * packs - full * (full - 1) / 2) + rest * (packs - full));
}

/// The number of values in the workspace that substitution needs for a front with `rows` rows.
template <class Real>
constexpr std::int64_t workspace_size(Index rows) {
  return 3 * std::int64_t{pack_rows<Real>} * packs_of<Real>(rows);
}

/// Copies the block of a factored front to `packed`, in this order.
template <class Real>
void pack_front(const FrontLayout<Real>& front, const Real* block, Real* packed);

/// Forward substitution with one packed front. `front` (rows x 4) holds the right-hand side W1 in
/// its first `columns` rows and the sum of the children's updates W2 in the others. Stores L11^-1
/// W1 in `own` (columns x 4) and W2 - L21 L11^-1 W1 in `below` ((rows - columns) x 4).
template <class Real>
void substitute_forward(const Real* packed, Index rows, Index columns, const Real* front, Real* own,
                        Real* below, Real* workspace);

/// Backward substitution. `row` (#rows) lists rows of x (n x 4): the first `columns` of them, which
/// are consecutive, hold W1, and the others hold W2. W1 becomes L11^-T (W1 - L21^T W2). The packed
/// numbers are read from their end.
template <class Real>
void substitute_backward(const Real* packed, Index rows, Index columns, const Index* row, Real* x,
                         Real* workspace);

}  // namespace ibmfair
