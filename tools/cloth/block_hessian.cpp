#include "cloth/block_hessian.h"

#include <algorithm>
#include <numeric>

namespace ibmfair::cloth {

BlockHessian::BlockHessian(const CompressedRows& elements, Index vertices)
    : pattern_(HessianAssembler(StencilTerms(elements, vertices),
                                Unknowns(std::vector<std::uint8_t>(vertices, 0)))
                   .pattern()),
      blocks_(pattern_.row.size(), Block::Zero()) {}

void BlockHessian::clear() {
  std::fill(blocks_.begin(), blocks_.end(), Block::Zero());
}

Index BlockHessian::place(Index i, Index j) const {
  const auto first = pattern_.row.begin() + pattern_.column_first[std::min(i, j)];
  const auto last = pattern_.row.begin() + pattern_.column_first[std::min(i, j) + 1];
  const auto found = std::lower_bound(first, last, std::max(i, j));
  const auto k = static_cast<Index>(found - pattern_.row.begin());
  return i >= j ? k : ~k;
}

std::vector<Index> BlockHessian::places(const CompressedRows& elements) const {
  std::vector<Index> places;
  for (Index e = 0; e < elements.size(); ++e) {
    for (std::size_t a = 0; a < elements[e].size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        places.push_back(place(elements[e][a], elements[e][b]));
      }
    }
  }
  return places;
}

Points BlockHessian::multiply(const Points& X) const {
  Points Y = Points::Zero(X.rows(), 3);
  for (Index j = 0; j < vertices(); ++j) {
    const std::int64_t diagonal = pattern_.column_first[j];
    Y.row(j) += X.row(j) * blocks_[diagonal];
    for (std::int64_t k = diagonal + 1; k < pattern_.column_first[j + 1]; ++k) {
      const auto i = static_cast<Index>(pattern_.row[k]);
      Y.row(i) += X.row(j) * blocks_[k].transpose();
      Y.row(j) += X.row(i) * blocks_[k];
    }
  }
  return Y;
}

}  // namespace ibmfair::cloth
