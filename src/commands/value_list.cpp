#include "commands/value_list.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "commands/printable.h"

namespace ibmfair::commands {

void ValueList::add(std::string label, std::string value) {
  lines_.emplace_back(std::move(label), std::move(value));
}

void ValueList::add(std::string label, double value) {
  add(std::move(label), eight_digits(value));
}

std::string ValueList::text() const {
  std::size_t width = 0;
  for (const auto& [label, value] : lines_) {
    width = std::max(width, label.size());
  }
  std::string text;
  for (const auto& [label, value] : lines_) {
    text += fmt::format("{:<{}}  {}\n", label, width, printable(value));
  }
  return text;
}

std::string eight_digits(double value) {
  return fmt::format("{:.8g}", value);
}

std::string change_text(double before, double after) {
  constexpr double most_percent = 1000;
  if (before == 0) {
    return "-";
  }
  constexpr double rounding = 1e-10;
  double percent = 100 * (after / before - 1);
  percent = std::abs(percent) < rounding ? 0 : percent;
  return std::abs(percent) < most_percent ? fmt::format("{:+.3g} %", percent)
                                          : fmt::format("x {:.3g}", after / before);
}

std::string counted(long long count, const std::string& singular, const std::string& plural) {
  return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

}  // namespace ibmfair::commands
