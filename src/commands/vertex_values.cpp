#include "commands/vertex_values.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "commands/text_words.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair::commands {
namespace {

std::string range_text(double least) {
  return std::isfinite(least) ? fmt::format("a finite number from {} on", least)
                              : std::string("a finite number");
}

std::vector<double> read_values(const std::string& path, std::size_t count, double least,
                                const std::string& option) {
  std::vector<double> values;
  for_words(option, path, [&](std::string_view word, std::int64_t line) {
    const std::optional<double> value = finite_number(word);
    if (!value || *value < least) {
      throw BadFile(
          fmt::format("{}: {}:{}: '{}' is not {}", option, path, line, word, range_text(least)));
    }
    values.push_back(*value);
  });
  if (values.size() != count) {
    throw BadFile(fmt::format("{}: {}: the file has {} numbers, but the mesh has {} vertices",
                              option, path, values.size(), count));
  }
  return values;
}

}  // namespace

std::optional<double> finite_number(std::string_view word) {
  double value = 0;
  const char* end = word.data() + word.size();
  return parse_real(word.data(), end, value) == end ? std::optional(value) : std::nullopt;
}

Eigen::VectorXd vertex_values(const MeshFile& file, const std::string& source, double least,
                              const std::string& option) {
  const auto count = static_cast<std::size_t>(file.mesh().X.rows());
  std::optional<std::vector<double>> values;
  if (std::filesystem::is_regular_file(source)) {
    values = read_values(source, count, least, option);
  } else if ((values = file.vertex_values(source))) {
    for (std::size_t v = 0; v < count; ++v) {
      require_vertex_value((*values)[v], least, static_cast<std::int64_t>(v), file.name(), source,
                           option);
    }
  } else {
    throw BadOption(fmt::format("{}: '{}' is neither a vertex property of {} nor a file", option,
                                source, file.name()));
  }
  return Eigen::Map<const Eigen::VectorXd>(values->data(), static_cast<Eigen::Index>(count));
}

Eigen::VectorXd vertex_values_or_number(const MeshFile& file, const std::string& source,
                                        const std::string& option) {
  if (const std::optional<double> number = finite_number(source)) {
    return Eigen::VectorXd::Constant(file.mesh().X.rows(), *number);
  }
  return vertex_values(file, source, -std::numeric_limits<double>::infinity(), option);
}

void require_vertex_value(double value, double least, std::int64_t vertex, const std::string& file,
                          const std::string& property, const std::string& option) {
  if (!std::isfinite(value) || value < least) {
    throw BadFile(fmt::format("{}: {}: {} of vertex {} is {}, not {}", option, file, property,
                              vertex, value, range_text(least)));
  }
}

}  // namespace ibmfair::commands
