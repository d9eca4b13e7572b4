// Updates on their way from children to parents: a stack, as the tree is visited bottom up.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

/// Memory for the updates of one branch, or of the trunk: `of[s]` is where that of s is.
template <class Real>
class UpdateStack {
 public:
  UpdateStack(const Supernodes& nodes, std::vector<Real*>& of, Real* memory)
      : nodes_(nodes), of_(of), top_(memory) {}

  /// The end of what it holds.
  Real* top() const { return top_; }

  /// Memory for the `size` numbers of s, while those of its children are still there.
  Real* push(Index s, std::int64_t size) {
    of_[s] = top_;
    top_ += size;
    return of_[s];
  }

  /// Memory for the `size` numbers of s where those of its children were.
  Real* push_over_children(Index s, std::int64_t size) {
    top_ = first_of_children(s, top_);
    return push(s, size);
  }

  /// Moves the numbers of s, the last ones pushed, down to where those of its children were.
  void take_room_of_children(Index s, std::int64_t size) {
    Real* const from = of_[s];
    of_[s] = first_of_children(s, from);
    if (of_[s] != from) {
      std::memmove(of_[s], from, static_cast<std::size_t>(size) * sizeof(Real));
    }
    top_ = of_[s] + size;
  }

 private:
  /// Where the numbers of the children of s begin, or `none`.
  Real* first_of_children(Index s, Real* none) const {
    for (const Index child : nodes_.children[s]) {
      // A parent in the trunk leaves what its children in branches hold.
      if (nodes_.branch_of[child] == nodes_.branch_of[s]) none = std::min(none, of_[child]);
    }
    return none;
  }

  const Supernodes& nodes_;
  std::vector<Real*>& of_;
  Real* top_;
};

/// The numbers that such a stack must hold for the supernodes in `list`, when that of s takes
/// size_of(s).
template <class List, class SizeOf>
std::int64_t stack_size(const Supernodes& nodes, const List& list, SizeOf&& size_of) {
  std::int64_t top = 0, peak = 0;
  for (const Index s : list) {
    top += size_of(s);
    peak = std::max(peak, top);
    for (const Index child : nodes.children[s]) {
      top -= nodes.branch_of[child] == nodes.branch_of[s] ? size_of(child) : 0;
    }
  }
  return peak;
}

}  // namespace ibmfair
