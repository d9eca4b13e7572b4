// A curve in one line of text.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

/// A bar for each of the values, which are finite, lowest to highest; on a logarithmic scale where
/// they are positive and the highest is more than five times the lowest. More than `columns` values
/// share their bars. In ASCII digits (0 lowest, 9 highest) unless `unicode`.
std::string sparkline(const std::vector<double>& values, std::size_t columns, bool unicode);

/// Whether the values are drawn on a logarithmic scale.
bool drawn_logarithmically(const std::vector<double>& values);

/// Whether the locale that the environment asks for is UTF-8.
bool locale_is_utf8();

}  // namespace ibmfair::commands
