#include "ibmfair/energy/unknowns.h"

namespace ibmfair {

Unknowns::Unknowns(const std::vector<std::uint8_t>& fixed, const std::vector<std::uint8_t>& own)
    : unknown(fixed.size(), -1) {
  Index next = 0;
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if (!fixed[v]) {
      unknown[v] = next++;
      if (own.empty() || own[v]) {
        vertex.push_back(static_cast<Index>(v));
      }
    }
  }
}

}  // namespace ibmfair
