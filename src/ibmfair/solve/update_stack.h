// A stack of the updates that children leave for their parents: the tree is visited in postorder.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "ibmfair/solve/supernodes.h"

namespace ibmfair {

/// Memory for the updates of one branch or of the trunk: `of[s]` points to the update of supernode
/// s.
template <class Real>
class UpdateStack {
 public:
  UpdateStack(const Supernodes& nodes, std::vector<Real*>& of, Real* memory)
      : nodes_(nodes), of_(of), top_(memory) {}

  /// The end of the updates on the stack.
  Real* top() const { return top_; }

  /// Allocates the `size` numbers of s above those of its children, which remain valid.
  Real* push(Index s, std::int64_t size) {
    of_[s] = top_;
    top_ += size;
    return of_[s];
  }

  /// Allocates the `size` numbers of s in place of those of its children.
  Real* push_over_children(Index s, std::int64_t size) {
    top_ = first_of_children(s, top_);
    return push(s, size);
  }

  /// Moves the numbers of s, the last ones pushed, down over the numbers of its children.
  void take_room_of_children(Index s, std::int64_t size) {
    Real* const from = of_[s];
    of_[s] = first_of_children(s, from);
    if (of_[s] != from) {
      std::memmove(of_[s], from, static_cast<std::size_t>(size) * sizeof(Real));
    }
    top_ = of_[s] + size;
  }

 private:
  /// The start of the numbers of the children of s, or `none` if it has none on this stack.
  Real* first_of_children(Index s, Real* none) const {
    for (const Index child : nodes_.children[s]) {
      // The updates of children in branches are not on the trunk's stack.
      if (nodes_.branch_of[child] == nodes_.branch_of[s]) none = std::min(none, of_[child]);
    }
    return none;
  }

  const Supernodes& nodes_;
  std::vector<Real*>& of_;
  Real* top_;
};

/// The capacity that such a stack needs for the supernodes in `list`, if the update of s has
/// size_of(s) numbers.
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
