#include "ibmfair/energy/incidence.h"

#include <numeric>

namespace ibmfair {

Rows places_by_vertex(const Rows& stencils, Index vertex_count) {
  Rows places;
  places.first.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Index v : stencils.value) {
    ++places.first[static_cast<std::size_t>(v) + 1];
  }
  std::partial_sum(places.first.begin(), places.first.end(), places.first.begin());
  places.value.resize(stencils.value.size());
  std::vector<std::int64_t> next(places.first.begin(), places.first.end() - 1);
  for (std::size_t i = 0; i < stencils.value.size(); ++i) {
    places.value[next[stencils.value[i]]++] = static_cast<Index>(i);
  }
  return places;
}

}  // namespace ibmfair
