#include "commands/sparkline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace ibmfair::commands {

namespace {

constexpr double most_linear_ratio = 5;

constexpr std::array<std::string_view, 8> blocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::array<std::string_view, 10> digits{"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};

template <std::size_t N>
std::string drawn(const std::vector<double>& values, const std::array<std::string_view, N>& signs) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double range = *highest - *lowest;
  std::string text;
  for (const double value : values) {
    const double height = range > 0 ? (value - *lowest) / range : 0;
    text += signs[std::min(N - 1, static_cast<std::size_t>(height * N))];
  }
  return text;
}

}  // namespace

bool drawn_logarithmically(const std::vector<double>& values) {
  if (values.empty()) {
    return false;
  }
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return *lowest > 0 && *highest > most_linear_ratio * *lowest;
}

std::string sparkline(const std::vector<double>& values, std::size_t columns, bool unicode) {
  if (values.empty() || columns == 0) {
    return "";
  }
  const bool logarithmic = drawn_logarithmically(values);
  const std::size_t count = std::min(columns, values.size());
  std::vector<double> heights;
  for (std::size_t i = 0; i < count; ++i) {
    // The selection includes the first and the last value.
    const std::size_t at = count == 1 ? 0 : i * (values.size() - 1) / (count - 1);
    heights.push_back(logarithmic ? std::log(values[at]) : values[at]);
  }
  return unicode ? drawn(heights, blocks) : drawn(heights, digits);
}

bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') {
      const std::string_view locale = value;
      return locale.find("UTF-8") != std::string_view::npos ||
             locale.find("utf8") != std::string_view::npos ||
             locale.find("UTF8") != std::string_view::npos ||
             locale.find("utf-8") != std::string_view::npos;
    }
  }
  return false;
}

}  // namespace ibmfair::commands
