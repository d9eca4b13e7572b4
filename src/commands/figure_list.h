// Figures for a person to read: labels on the left, values in a column.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ibmfair::commands {

class FigureList {
 public:
  void add(std::string label, std::string value);

  /// Adds the value with eight significant digits.
  void add(std::string label, double value);

  /// One line a figure, whatever its value holds: see commands/printable.h.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// Eight significant digits.
std::string figure(double value);

/// From `before` to `after`, in per cent, or as a factor where that is large.
std::string change_text(double before, double after);

/// "1 face", "2 faces".
std::string counted(long long count, const std::string& singular, const std::string& plural);

}  // namespace ibmfair::commands
