// Disjoint sets (union-find), for components and fans.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Disjoint sets over 0 .. count - 1; the representative of a set is its smallest member.
class UnionFind {
 public:
  explicit UnionFind(Index count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  Index find(Index i) {
    while (parent_[i] != i) {
      i = parent_[i] = parent_[parent_[i]];  // path halving
    }
    return i;
  }

  void unite(Index i, Index j) {
    i = find(i);
    j = find(j);
    if (i != j) {
      parent_[std::max(i, j)] = std::min(i, j);
    }
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace ibmfair
