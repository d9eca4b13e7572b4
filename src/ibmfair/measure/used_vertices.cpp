#include "ibmfair/measure/used_vertices.h"

#include <algorithm>

namespace ibmfair {

std::vector<Index> used_vertices(const Triangles& F) {
  std::vector<Index> used(F.data(), F.data() + F.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

Points used_positions(const Points& X, const Triangles& F) {
  return X(used_vertices(F), Eigen::all);
}

}  // namespace ibmfair
