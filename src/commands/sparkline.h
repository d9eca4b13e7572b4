// A curve in one line of text.
#pragma once

#include <string>
#include <vector>

namespace ibmfair::commands {

/// Draws one bar per value; the values must be finite. The scale reaches from the lowest to the
/// highest value, and is logarithmic if drawn_logarithmically(). If there are more than `columns`
/// values, an even selection that includes the first and the last value is drawn. Bars are ASCII
/// digits (0 lowest, 9 highest) unless `unicode`.
std::string sparkline(const std::vector<double>& values, std::size_t columns, bool unicode);

/// Whether the values are drawn on a logarithmic scale: if they are positive and the highest value
/// is more than five times the lowest.
bool drawn_logarithmically(const std::vector<double>& values);

/// Whether the locale in the environment uses UTF-8.
bool locale_is_utf8();

}  // namespace ibmfair::commands
