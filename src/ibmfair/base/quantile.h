// Values by their rank.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace ibmfair {

/// The value that stands `share` (0 to 1, less than 1) of the way along the sorted values: the
/// smallest one for 0, the median for 0.5, the upper of the two middle ones where their number is
/// even. Reorders the values, of which there must be one at least.
inline double quantile(std::span<double> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * values.size());
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

inline double median(std::span<double> values) {
  return quantile(values, 0.5);
}

}  // namespace ibmfair
