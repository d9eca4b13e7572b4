#include "ibmfair/fill/hole_groups.h"

#include <map>
#include <unordered_map>

#include "ibmfair/fill/patch.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {

std::vector<std::vector<Index>> group_holes(const Topology& topology,
                                            const std::vector<Hole>& holes,
                                            const std::vector<Index>& chosen, int free_rings,
                                            const std::vector<Index>& surrounding) {
  UnionFind sets(static_cast<Index>(holes.size()));
  std::unordered_map<Index, Index> first_hole;  // for each vertex, the first hole that reaches it
  for (const Index h : chosen) {
    if (surrounding[h] >= 0) {
      sets.unite(h, surrounding[h]);
    }
    std::vector<Index> reach = holes[h].loop;
    for (int ring = 0; ring < free_rings; ++ring) {
      reach = grown_by_ring(topology, reach);
    }
    for (const Index v : reach) {
      const auto [it, fresh] = first_hole.emplace(v, h);
      if (!fresh) {
        sets.unite(it->second, h);
      }
    }
  }
  std::map<Index, std::vector<Index>> groups;
  for (const Index h : chosen) {
    groups[sets.find(h)].push_back(h);
  }
  std::vector<std::vector<Index>> result;
  result.reserve(groups.size());
  for (auto& [first, group] : groups) {
    result.push_back(std::move(group));
  }
  return result;
}

}  // namespace ibmfair
