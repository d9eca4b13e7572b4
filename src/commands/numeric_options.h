// Options that take numbers. The whole text must be a number within the range of the option;
// messages about errors name the option.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// The numbers that an option takes. Infinities and NaN never belong to a range.
struct Range {
  double smallest = -std::numeric_limits<double>::infinity();
  double largest = std::numeric_limits<double>::infinity();
  bool above_smallest = false;  ///< `smallest` itself does not belong to the range
};

constexpr Range any_real{};
constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true};
constexpr Range not_negative{0.0};
constexpr Range turning_angle{0.0, 180.0, true};  ///< degrees

/// Parses the whole text as a finite number. Throws BadOption with a message that starts with
/// `name`.
double parse_real_option(std::string_view name, std::string_view text, const Range& range);

/// Parses the whole text as an integer between `smallest` and `largest`. Throws BadOption with a
/// message that starts with `name`.
std::int64_t parse_integer_option(std::string_view name, std::string_view text,
                                  std::int64_t smallest, std::int64_t largest);

/// Parses the whole text as `count` numbers separated by commas. Throws BadOption with a message
/// that starts with `name`.
std::vector<double> parse_reals_option(std::string_view name, std::string_view text,
                                       std::size_t count, const Range& range);

/// Returns parse(), which parses a number. If it throws BadOption, throws BadOption with the same
/// message and the remark that the option also takes the word `other`.
template <class Parse>
auto or_other(std::string_view other, const Parse& parse) {
  try {
    return parse();
  } catch (const BadOption& error) {
    throw BadOption(fmt::format("{}, or {}", error.what(), other));
  }
}

/// Declares an option whose text is passed to `set`, which throws BadOption for an invalid text.
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, const std::string& type,
                               const std::string& help,
                               const std::function<void(const std::string&)>& set);

/// Sets the default value that `ibmfair COMMAND --dump-config` and the help show. A value outside
/// the range of the option means that there is no default.
void show_default(CLI::Option& option, double value, const Range& range);
void show_default(CLI::Option& option, std::int64_t value, std::int64_t smallest,
                  std::int64_t largest);

/// Declares an option for a number. Target is a number type, and the value of `target` is then the
/// default; or Target is std::optional of a number type.
template <class Target>
CLI::Option* add_real(CLI::App& app, const std::string& name, Target& target, Range range,
                      const std::string& help) {
  CLI::Option* option = add_parsed_option(
      app, name, "NUMBER", help,
      [&target, name, range](const auto& text) { target = parse_real_option(name, text, range); });
  if constexpr (std::is_arithmetic_v<Target>) {
    show_default(*option, static_cast<double>(target), range);
  }
  return option;
}

/// Declares an option for an amount of memory in bytes: a number, optionally followed by k, M, G or
/// T for the powers 10^3, 10^6, 10^9 and 10^12.
CLI::Option* add_bytes(CLI::App& app, const std::string& name, double& target,
                       const std::string& help);

/// Declares an option for an integer of the type `Integer`, the type of `smallest`.
template <class Target, class Integer>
CLI::Option* add_integer(CLI::App& app, const std::string& name, Target& target, Integer smallest,
                         Integer largest, const std::string& help) {
  CLI::Option* option =
      add_parsed_option(app, name, "N", help, [&target, name, smallest, largest](const auto& text) {
        target = static_cast<Integer>(parse_integer_option(name, text, smallest, largest));
      });
  if constexpr (std::is_arithmetic_v<Target>) {
    show_default(*option, static_cast<std::int64_t>(target), smallest, largest);
  }
  return option;
}

}  // namespace ibmfair::commands
