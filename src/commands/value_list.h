// A list of labelled values as text: labels on the left, values in a column.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ibmfair::commands {

class ValueList {
 public:
  void add(std::string label, std::string value);

  /// Adds the value with eight significant digits.
  void add(std::string label, double value);

  /// One line per value; control characters in values are escaped (commands/printable.h).
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// The value with eight significant digits.
std::string eight_digits(double value);

/// The change from `before` to `after` in per cent, or as a factor if it is 1000 % or more; `-` if
/// `before` is 0.
std::string change_text(double before, double after);

/// "1 face", "2 faces".
std::string counted(long long count, const std::string& singular, const std::string& plural);

}  // namespace ibmfair::commands
