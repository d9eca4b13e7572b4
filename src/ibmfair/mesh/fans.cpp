#include "ibmfair/mesh/fans.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/select.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

/// Walks around v from its first triangle, in both directions, and tells whether every triangle at
/// v is reached. For stars of at most most_in_short_star triangles.
bool is_one_short_fan(const Topology& topology, Index v) {
  const auto star = topology.stars[v];
  auto [back, front] = other_corners(topology.F, star[0], v);  // the two ends of the walk
  std::array<std::array<Index, 2>, most_in_short_star> ahead;  // the triangles not reached yet
  std::size_t left = star.size() - 1;
  for (std::size_t i = 0; i < left; ++i) {
    ahead[i] = other_corners(topology.F, star[i + 1], v);
  }
  // The sweep has no branches, because the processor cannot predict which triangle comes next.
  for (std::size_t before = left + 1; left > 0 && left < before;) {
    before = std::exchange(left, 0);
    for (std::size_t i = 0; i < before; ++i) {
      const auto [p, q] = ahead[i];
      const bool at_front = (p == front) | (q == front);
      const bool at_back = (!at_front) & ((p == back) | (q == back));
      front = at_front ? p ^ q ^ front : front;  // proceed to the other corner of the triangle
      back = at_back ? p ^ q ^ back : back;
      ahead[left] = {p, q};
      left += (at_front | at_back) ? 0 : 1;
    }
  }
  return left == 0;
}

/// For each triangle at v, the place in the star of the first triangle in the same fan.
std::vector<Index> first_in_fan(const Topology& topology, Index v) {
  // The side from v to the vertex `end`, in the triangle at this place in the star.
  struct Side {
    Index end, place;
  };
  const auto star = topology.stars[v];
  const auto size = static_cast<Index>(star.size());
  std::vector<Side> sides;
  for (Index place = 0; place < size; ++place) {
    for (const Index end : other_corners(topology.F, star[place], v)) {
      sides.push_back({end, place});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.end < b.end; });

  UnionFind fans(size);
  for (auto side = sides.begin(); side != sides.end();) {
    const auto next =
        std::find_if(side, sides.end(), [&](const Side& s) { return s.end != side->end; });
    if (next - side == 2) {
      fans.unite(side[0].place, side[1].place);
    }
    side = next;
  }
  std::vector<Index> first(star.size());
  for (Index place = 0; place < size; ++place) {
    first[place] = fans.find(place);
  }
  return first;
}

}  // namespace

void walk_around(const Topology& topology, Index v, Index* ring) {
  const auto star = topology.stars[v];
  std::array<std::array<Index, 2>, most_in_short_star> side;  // of each triangle, opposite v
  for (std::size_t i = 0; i < star.size(); ++i) {
    side[i] = other_corners(topology.F, star[i], v);
  }
  Index at = side[0][0];
  for (std::size_t step = 0; step < star.size(); ++step) {
    ring[step] = at;
    Index next = at;
    for (std::size_t i = 0; i < star.size(); ++i) {  // without branches, as in is_one_short_fan()
      next = side[i][0] == at ? side[i][1] : next;
    }
    at = next;
  }
}

bool is_one_fan(const Topology& topology, Index v) {
  if (topology.stars[v].size() <= most_in_short_star) {
    return is_one_short_fan(topology, v);
  }
  const std::vector<Index> first = first_in_fan(topology, v);
  return std::all_of(first.begin(), first.end(), [](Index place) { return place == 0; });
}

Fans::Fans(const Topology& topology)
    : bound_(topology.vertex_count), irregular_(indices_where(topology.vertex_count, [&](Index v) {
        return topology.kind[v] == VertexKind::irregular;
      })) {
  for (const Index v : irregular_) {
    const std::vector<Index> first = first_in_fan(topology, v);
    const auto row = static_cast<std::ptrdiff_t>(fan_.value.size());
    for (Index place = 0; place < static_cast<Index>(first.size()); ++place) {
      fan_.value.push_back(first[place] == place ? bound_++ : fan_.value[row + first[place]]);
    }
    fan_.first.push_back(static_cast<std::int64_t>(fan_.value.size()));
  }
}

Index Fans::at(const Topology& topology, Index t, Index v) const {
  if (topology.kind[v] != VertexKind::irregular) {
    return v;
  }
  const auto row = std::lower_bound(irregular_.begin(), irregular_.end(), v) - irregular_.begin();
  const auto star = topology.stars[v];
  const auto place = std::lower_bound(star.begin(), star.end(), t) - star.begin();
  return fan_[static_cast<Index>(row)][static_cast<std::size_t>(place)];
}

}  // namespace ibmfair
