// A set of edges: unordered pairs of vertices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_set>

#include "ibmfair/base/types.h"

namespace ibmfair {

class EdgeSet {
 public:
  void add(Index a, Index b) { keys_.insert(key(a, b)); }
  bool contains(Index a, Index b) const { return keys_.contains(key(a, b)); }

 private:
  static std::uint64_t key(Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
  }
  std::unordered_set<std::uint64_t> keys_;
};

}  // namespace ibmfair
