#include "ibmfair/flow/settings/rim_paths.h"

#include "ibmfair/flow/tuning.h"

namespace ibmfair {

std::vector<Index> RimPaths::find(Index from, Index to, double longest) {
  reached_.clear();
  queue_ = {};
  for (const Index v : topology_.F.row(from)) {
    visit(v, -1, 0);
  }
  for (int seen = 0; !queue_.empty();) {
    const auto [length, v] = queue_.top();
    queue_.pop();
    if (length > reached_.at(v).length) {
      continue;
    }
    if ((topology_.F.row(to).array() == v).any()) {
      return path_to(v);
    }
    const auto ring = rings_[v];
    seen += static_cast<int>(ring.size());
    if (seen > tuning.thin_walls.most_seen) {
      return {};
    }
    for (const Index w : ring) {
      const double there = length + (X_.row(w) - X_.row(v)).norm();
      if (there <= longest) {
        visit(w, v, there);
      }
    }
  }
  return {};
}

void RimPaths::visit(Index v, Index before, double length) {
  const auto [place, is_new] = reached_.try_emplace(v, Reached{length, before});
  if (is_new || length < place->second.length) {
    place->second = {length, before};
    queue_.emplace(length, v);
  }
}

std::vector<Index> RimPaths::path_to(Index v) const {
  std::vector<Index> path;
  for (; v >= 0; v = reached_.at(v).before) {
    path.push_back(v);
  }
  return path;
}

}  // namespace ibmfair
