#include "commands/numeric_options.h"

#include <cmath>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/documentation.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair::commands {

namespace {

std::string describe(const Range& range) {
  const std::string most =
      std::isfinite(range.largest) ? fmt::format("at most {}", range.largest) : "";
  if (!std::isfinite(range.smallest)) {
    return most.empty() ? "a number" : "a number of " + most;
  }
  return fmt::format("a number {} {}{}", range.above_smallest ? "above" : "of at least",
                     range.smallest, most.empty() ? "" : " and " + most);
}

bool contains(const Range& range, double value) {
  return std::isfinite(value) && value <= range.largest &&
         (range.above_smallest ? value > range.smallest : value >= range.smallest);
}

}  // namespace

double parse_real_option(std::string_view name, std::string_view text, const Range& range) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  if (parse_real(text.data(), end, value) != end) {
    throw BadOption(
        fmt::format("{}: '{}' is not a finite number; write {}", name, text, describe(range)));
  }
  if (!contains(range, value)) {
    throw BadOption(fmt::format("{}: {} is out of range; write {}", name, text, describe(range)));
  }
  return value;
}

std::int64_t parse_integer_option(std::string_view name, std::string_view text,
                                  std::int64_t smallest, std::int64_t largest) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  if (parse_integer(text.data(), end, value) != end) {
    throw BadOption(fmt::format("{}: '{}' is not a whole number; write one from {} to {}", name,
                                text, smallest, largest));
  }
  if (value < smallest || value > largest) {
    throw BadOption(fmt::format("{}: {} is out of range; write a whole number from {} to {}", name,
                                text, smallest, largest));
  }
  return value;
}

std::vector<double> parse_reals_option(std::string_view name, std::string_view text,
                                       std::size_t count, const Range& range) {
  std::vector<double> values;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    values.push_back(parse_real_option(name, rest.substr(0, comma), range));
    if (comma == std::string_view::npos) {
      break;
    }
    rest.remove_prefix(comma + 1);
  }
  if (values.size() != count) {
    throw BadOption(fmt::format("{}: '{}' has {} numbers; write {} of them, separated by commas",
                                name, text, values.size(), count));
  }
  return values;
}

CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, const std::string& type,
                               const std::string& help,
                               const std::function<void(const std::string&)>& set) {
  return app.add_option_function<std::string>(name, set, help)->type_name(type);
}

CLI::Option* add_bytes(CLI::App& app, const std::string& name, double& target,
                       const std::string& help) {
  const auto set = [&target, name](const std::string& text) {
    constexpr std::string_view units = "kMGT";
    const std::size_t unit = text.empty() ? std::string_view::npos : units.find(text.back());
    const bool has_unit = unit != std::string_view::npos;
    const double number = parse_real_option(
        name, std::string_view(text).substr(0, text.size() - (has_unit ? 1 : 0)), positive);
    target = has_unit ? number * std::pow(1000.0, static_cast<double>(unit + 1)) : number;
  };
  CLI::Option* option = add_parsed_option(app, name, "BYTES", help, set);
  note_of(app, *option).unit = "bytes, or k, M, G or T of them";
  return option;
}

void show_default(CLI::Option& option, double value, const Range& range) {
  if (contains(range, value)) {
    option.default_str(fmt::format("{}", value));
  }
}

void show_default(CLI::Option& option, std::int64_t value, std::int64_t smallest,
                  std::int64_t largest) {
  if (value >= smallest && value <= largest) {
    option.default_str(fmt::format("{}", value));
  }
}

}  // namespace ibmfair::commands
