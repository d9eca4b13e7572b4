#include "ibmfair/flow/settings/height_differences.h"

namespace ibmfair {

HeightDifferences::HeightDifferences(const std::vector<Index>& counted, const Unknowns& unknowns,
                                     const Topology& topology) {
  std::vector<Index> position(topology.stars.size(), -1);
  for (std::size_t i = 0; i < counted.size(); ++i) {
    position[unknowns.vertex[counted[i]]] = static_cast<Index>(i);
  }
  Edges pairs(topology.E.rows(), 2);
  Index count = 0;
  for (const auto& edge : topology.E.rowwise()) {
    if (position[edge[0]] >= 0 && position[edge[1]] >= 0) {
      pairs.row(count++) << position[edge[0]], position[edge[1]];
    }
  }
  neighbours_ = pairs.topRows(count);
}

}  // namespace ibmfair
