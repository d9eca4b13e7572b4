// The rows of S = sum_s w_s c_s c_s^T ([W07] section 2.3) that belong to the unknowns. They are
// summed again each time the weights change, but the position in its row that each term is added to
// is determined only once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/stencil_terms.h"
#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

/// The columns of some consecutive rows: those of row i of the block are column[first[i]] to
/// column[first[i + 1] - 1].
struct RowBlock {
  std::vector<std::int64_t> first{0};
  std::vector<Index> column;
};

class RowSums {
 public:
  /// Which of the other unknowns in its stencils a row lists: `later` only the later ones, in
  /// increasing order; `all_in_pairs` all of them. If their number is odd, `all_in_pairs` appends
  /// the row's own unknown once more with the entry zero.
  enum class Others : std::uint8_t { later, all_in_pairs };

  /// Keeps a reference to `terms`.
  RowSums(const StencilTerms& terms, const Unknowns& unknowns, Others others);

  std::int64_t size() const { return static_cast<std::int64_t>(vertex_.size()); }

  /// Rows in a block; only the last block may have fewer. No range of parallel_block_sum spans two
  /// blocks.
  static constexpr std::int64_t block_size = 4 * sum_block;

  /// The columns of all rows. The row of unknown u is in block u / block_size and lists u itself,
  /// then the others.
  const std::vector<RowBlock>& blocks() const { return blocks_; }

  /// Calls take(u, entries, rest) for every unknown u, on all threads: entries[k] is S_uv for the
  /// k-th column v of the row, and `rest` is the sum of S_uv over all v that the row does not list.
  template <class Take>
  void for_rows(const StencilWeights& weights, const Take& take) const {
    const auto sum_up = [&](std::int64_t begin, std::int64_t end, std::vector<double>& sum) {
      const std::vector<std::int64_t>& first = blocks_[begin / block_size].first;
      const Places& places = places_[begin / block_size];
      const std::uint8_t* narrow = places.narrow.data();
      const Index* wide = places.wide.data();
      for (std::int64_t u = begin; u < end; ++u) {
        const std::int64_t width = first[u - begin + 1] - first[u - begin];
        std::fill_n(sum.begin(), width + 1, 0.0);
        if (width <= widest_narrow) {
          narrow = add_terms(u, weights, narrow, sum.data());
        } else {
          wide = add_terms(u, weights, wide, sum.data());
        }
        take(static_cast<Index>(u),
             std::span<const double>(&sum[1], static_cast<std::size_t>(width)), sum[0]);
      }
    };
    parallel_parts<double>(size(), block_size, widest_ + 1, sum_up);
  }

 private:
  static constexpr std::int64_t widest_narrow = 255;

  /// The place of every term of the rows of a block, in order: k + 1 for the k-th column of the
  /// row, 0 for a vertex that the row does not list. Only rows with many columns need more than one
  /// byte.
  struct Places {
    std::vector<std::uint8_t> narrow;
    std::vector<Index> wide;
  };

  void find_row(const Unknowns& unknowns, Index u, Others others, std::vector<Index>& place_of,
                std::vector<Index>& columns, Places& places) const;

  template <class Place>
  const Place* add_terms(std::int64_t u, const StencilWeights& weights, const Place* place,
                         double* sum) const {
    terms_.for_terms(vertex_[u], weights, [&](Index /*w*/, double term) { sum[*place++] += term; });
    return place;
  }

  const StencilTerms& terms_;
  std::vector<Index> vertex_;  // the vertex of each unknown
  std::vector<RowBlock> blocks_;
  std::vector<Places> places_;  // one per block
  std::size_t widest_ = 0;
};

}  // namespace ibmfair
