#include "ibmfair/mesh/orientation.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

/// The edges of exactly two triangles, listed by triangle.
Rows shared_edges(const Topology& topology) {
  std::vector<std::pair<Index, Index>> links;
  for (Index e = 0; e < topology.E.rows(); ++e) {
    if (const auto t = topology.edge_triangles[e]; t.size() == 2) {
      links.emplace_back(t[0], e);
      links.emplace_back(t[1], e);
    }
  }
  std::sort(links.begin(), links.end());
  Rows rows;
  rows.value.reserve(links.size());
  auto link = links.begin();
  for (Index t = 0; t < topology.F.rows(); ++t) {
    for (; link != links.end() && link->first == t; ++link) {
      rows.value.push_back(link->second);
    }
    rows.first.push_back(static_cast<std::int64_t>(rows.value.size()));
  }
  return rows;
}

}  // namespace

void orient_coherently(Topology& topology) {
  const Index triangle_count = static_cast<Index>(topology.F.rows());
  const Rows edges_of = shared_edges(topology);
  constexpr signed char unseen = -1;
  std::vector<signed char> turn(static_cast<std::size_t>(triangle_count), unseen);
  topology.twisted.assign(static_cast<std::size_t>(topology.vertex_count), 0);

  std::vector<Index> patch;
  for (Index seed = 0; seed < triangle_count; ++seed) {
    if (turn[seed] != unseen) {
      continue;
    }
    patch.assign(1, seed);
    turn[seed] = 0;
    Index turned = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const Index t = patch[next];
      for (const Index e : edges_of[t]) {
        const auto pair = topology.edge_triangles[e];
        const Index other = pair[0] == t ? pair[1] : pair[0];
        const Index a = topology.E(e, 0), b = topology.E(e, 1);
        const bool agree = runs_along(topology.F, t, a, b) != runs_along(topology.F, other, a, b);
        const auto wanted = static_cast<signed char>(agree ? turn[t] : 1 - turn[t]);
        if (turn[other] == unseen) {
          turn[other] = wanted;
          turned += wanted;
          patch.push_back(other);
        } else if (turn[other] != wanted) {
          topology.orientable = false;
          topology.twisted[a] = topology.twisted[b] = 1;
        }
      }
    }
    const bool majority_turned = 2 * static_cast<std::size_t>(turned) > patch.size();
    for (const Index t : patch) {
      if ((turn[t] == 1) != majority_turned) {
        std::swap(topology.F(t, 1), topology.F(t, 2));
        ++topology.turned_triangles;
      }
    }
    for (const Index t : patch) {
      turn[t] = 2;
    }
  }
}

}  // namespace ibmfair
