// The Hessian of an energy whose terms couple the coordinates: sparse, symmetric, a 3 x 3 block for
// every two vertices that share an element.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/types.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair::cloth {

using Block = Eigen::Matrix3d;

/// The pattern is built once; values can be cleared and added to. Only blocks (i, j) with i >= j
/// are kept.
class BlockHessian {
 public:
  /// A block for each pair of the `vertices` that share a row of `elements`, and on the diagonal.
  BlockHessian(const CompressedRows& elements, Index vertices);

  void clear();

  /// The place of the block of vertices i and j, which must share an element: its number, or the
  /// complement (~) of the number if the transpose of the block is stored.
  Index place(Index i, Index j) const;

  /// For each row of `elements`, all of the same length k, the places of the pairs (a, b) with
  /// b <= a of its vertices, k (k + 1) / 2 of them: (0,0), (1,0), (1,1), (2,0), ...
  std::vector<Index> places(const CompressedRows& elements) const;

  /// Adds d^2 E / dx_i dx_j to the block at `place(i, j)`.
  template <class Derived>
  void add(Index place, const Eigen::MatrixBase<Derived>& B) {
    if (place >= 0) {
      blocks_[place] += B;
    } else {
      blocks_[~place] += B.transpose();
    }
  }

  /// Adds s times the unit matrix.
  void add_to_diagonal(Index place, double s) {
    blocks_[place < 0 ? ~place : place].diagonal().array() += s;
  }

  /// H X, #V x 3.
  Points multiply(const Points& X) const;

  Index vertices() const { return static_cast<Index>(pattern_.size()); }

  /// Block k is at `blocks()[k]`, in row pattern().row[k] of its column.
  const std::vector<Block>& blocks() const { return blocks_; }
  const SymmetricMatrix& pattern() const { return pattern_; }

 private:
  SymmetricMatrix pattern_;  // of the blocks
  std::vector<Block> blocks_;
};

}  // namespace ibmfair::cloth
