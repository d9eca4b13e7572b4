#include "commands/length.h"

#include <algorithm>
#include <array>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair::commands {
namespace {

/// Whether the text is meant as a length, though it may not be a positive one: "0", "-1e".
bool looks_like_length(std::string_view text) {
  if (!text.empty() && std::string_view("e%u").find(text.back()) != std::string_view::npos) {
    text.remove_suffix(1);
  }
  double value = 0;
  const char* end = text.data() + text.size();
  return !text.empty() && parse_real(text.data(), end, value) == end;
}

/// The options that add_optional_length declares.
constexpr std::array<std::string_view, 2> optional_lengths{"--weld", "--stitch"};

}  // namespace

double Length::on(const Points& X, const Topology& topology, const MeshParts& parts) const {
  switch (unit) {
    case Unit::edges:
      return value * mean_edge_length(X, topology, parts);
    case Unit::diagonal:
      return value / 100 * diagonal(X, parts);
    case Unit::absolute:
      break;
  }
  return value;
}

Length parse_length_option(std::string_view name, std::string_view text, Length::Unit unit) {
  std::string_view number = text;
  if (!number.empty()) {
    const char last = number.back();
    if (last == 'e' || last == '%' || last == 'u') {
      unit = last == 'e'   ? Length::Unit::edges
             : last == '%' ? Length::Unit::diagonal
                           : Length::Unit::absolute;
      number.remove_suffix(1);
    }
  }
  try {
    return {parse_real_option(name, number, positive), unit};
  } catch (const BadOption&) {
    throw BadOption(fmt::format(
        "{}: '{}' is not a positive length; write 8e (mean edge lengths), 2% (of the bounding "
        "box's diagonal) or 0.5u (mesh units)",
        name, text));
  }
}

Length parse_length_or(std::string_view name, std::string_view text, Length::Unit unit,
                       std::string_view other) {
  return or_other(other, [&] { return parse_length_option(name, text, unit); });
}

CLI::Option* add_optional_length(CLI::App& app, const std::string& name, Length::Unit unit,
                                 const std::string& help,
                                 const std::function<void(std::optional<Length>)>& set) {
  auto text = std::make_shared<std::string>();  // the parser stores the value here
  CLI::Option* option =
      app.add_flag(name, *text, help + " (the next word is its LENGTH only if it is a number)");
  option->type_name("LENGTH")->each([text, name, unit, set](const std::string& word) {
    if (word == flag_alone) {
      set(std::nullopt);
    } else {
      set(parse_length_or(name, word, unit, "nothing behind " + name));
    }
  });
  note_units_of_length(app, *option, unit);
  return option;
}

std::vector<std::string> join_optional_lengths(std::vector<std::string> words) {
  std::vector<std::string> joined;
  for (std::string& word : words) {
    const bool after_option =
        !joined.empty() &&
        std::ranges::find(optional_lengths, joined.back()) != optional_lengths.end();
    if (after_option && looks_like_length(word)) {
      joined.back() += "=" + word;
    } else {
      joined.push_back(std::move(word));
    }
  }
  return joined;
}

void note_units_of_length(CLI::App& app, const CLI::Option& option, Length::Unit unit) {
  note_of(app, option).unit =
      unit == Length::Unit::edges
          ? "mean edge lengths (8 or 8e), % of the bounding box's diagonal (2%), mesh units (0.5u)"
          : "mesh units (0.5 or 0.5u), mean edge lengths (8e), % of the bounding box's diagonal "
            "(2%)";
}

}  // namespace ibmfair::commands
