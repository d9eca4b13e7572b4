// Options that take numbers. Every one is checked to its last character and against its range, and
// messages name the option.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ibmfair::commands {

/// The numbers an option takes; infinities and NaN never belong to it.
struct Range {
  double smallest = -std::numeric_limits<double>::infinity();
  double largest = std::numeric_limits<double>::infinity();
  bool above_smallest = false;  ///< `smallest` itself does not belong to it
};

constexpr Range any_real{};
constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true};
constexpr Range not_negative{0.0};

/// The finite number that `text` is as a whole. Throws BadOption that starts with `name`.
double parse_real_option(std::string_view name, std::string_view text, const Range& range);

/// The integer that `text` is as a whole, between `smallest` and `largest`. Throws BadOption that
/// starts with `name`.
std::int64_t parse_integer_option(std::string_view name, std::string_view text,
                                  std::int64_t smallest, std::int64_t largest);

/// The `count` numbers, separated by commas, that `text` consists of. Throws BadOption that starts
/// with `name`.
std::vector<double> parse_reals_option(std::string_view name, std::string_view text,
                                       std::size_t count, const Range& range);

/// Declares an option whose text goes to `set`, which throws BadOption where it does not like it.
CLI::Option* add_parsed_option(CLI::App& app, const std::string& name, const std::string& type,
                               const std::string& help,
                               const std::function<void(const std::string&)>& set);

/// Tells `ibmfair COMMAND --dump-config` what the option is where it is not given; a value that the
/// option itself would not take stands for none.
void show_default(CLI::Option& option, double value, const Range& range);
void show_default(CLI::Option& option, std::int64_t value, std::int64_t smallest,
                  std::int64_t largest);

/// Declares an option for a number; Target is a number, which is its default, or std::optional of
/// one.
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

/// Declares an option for an amount of memory in bytes: a number, or one with k, M, G or T behind
/// it for its thousands.
CLI::Option* add_bytes(CLI::App& app, const std::string& name, double& target,
                       const std::string& help);

/// Declares an option for an integer that `Integer`, the type of `smallest`, can hold.
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
