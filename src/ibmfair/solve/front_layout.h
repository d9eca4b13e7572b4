// The memory layout of a front during its factorization. Both the block of the front's own columns
// and the update for its parent are stored in packs of rows, each pack column by column, so that
// kernels access memory sequentially and with whole vectors.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Rows of a pack: as many as fill 32 bytes.
template <class Real>
constexpr Index pack_rows = 32 / sizeof(Real);

/// Columns that kernels process together.
constexpr Index panel_width = 4;

template <class Real>
constexpr Index packs_of(Index rows) {
  return (rows + pack_rows<Real> - 1) / pack_rows<Real>;
}

/// The two parts of a front: its own columns, and the update, the columns of its ancestors.
enum class FrontPart : std::uint8_t { block, update };

/// A front of `rows` rows; the first `columns` rows and columns are its own. Entry (i, j), i >= j,
/// is at offset in(part, i) + pack_rows * j in the numbers of the part.
template <class Real>
struct FrontLayout {
  static constexpr Index pack = pack_rows<Real>;

  Index rows, columns;

  Index packs() const { return packs_of<Real>(rows); }

  /// The distance from pack to pack of the block, with room for whole panels.
  std::ptrdiff_t stride() const {
    const Index panels = (columns + panel_width - 1) / panel_width;
    return std::ptrdiff_t{pack} * panel_width * panels;
  }
  std::int64_t block_size() const { return packs() * std::int64_t{stride()}; }
  std::ptrdiff_t in_block(Index i) const { return i / pack * stride() + i % pack; }

  /// The first pack of the update. Its first rows may be the front's own; they are unused.
  Index first_pack() const { return columns / pack; }
  /// Each pack has room for one pack of columns more than the pack before it.
  std::int64_t update_size() const {
    return rows > columns ? before_pack(packs() - first_pack()) : 0;
  }
  std::ptrdiff_t in_update(Index i) const {
    return before_pack(i / pack - first_pack()) - std::ptrdiff_t{pack} * pack * first_pack() +
           i % pack;
  }

  std::ptrdiff_t in(FrontPart part, Index i) const {
    return part == FrontPart::block ? in_block(i) : in_update(i);
  }

 private:
  static std::ptrdiff_t before_pack(std::ptrdiff_t p) { return p * (p + 1) / 2 * pack * pack; }
};

}  // namespace ibmfair
