// Lengths as users give them: in the mesh's own units, or relative to the mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands/numeric_options.h"
#include "ibmfair/base/types.h"
#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// A length with its unit: `e` mean edge lengths, `%` of the bounding box's diagonal, `u` the units
/// of the mesh's coordinates.
struct Length {
  enum class Unit : std::uint8_t { edges, diagonal, absolute };
  double value = 0;
  Unit unit = Unit::edges;

  /// The length in the units of the coordinates X.
  double on(const Points& X, const Topology& topology,
            const MeshParts& parts = MeshParts::one()) const;
};

/// Parses a positive number followed by `e`, `%` or `u`; without suffix the unit is `unit`. Throws
/// BadOption with a message that starts with `name`.
Length parse_length_option(std::string_view name, std::string_view text, Length::Unit unit);

/// Parses the length of an option that also takes the word `other`, which the message then names.
Length parse_length_or(std::string_view name, std::string_view text, Length::Unit unit,
                       std::string_view other);

/// Documents for the help which units the option takes.
void note_units_of_length(CLI::App& app, const CLI::Option& option, Length::Unit unit);

/// Declares a flag that takes a length as its optional value: `--weld`, `--weld=1e-6u` or `--weld
/// 1e-6u`. The help also says that the next word is the value only if it is a length. `set` is
/// called with no length if only the flag is given.
CLI::Option* add_optional_length(CLI::App& app, const std::string& name, Length::Unit unit,
                                 const std::string& help,
                                 const std::function<void(std::optional<Length>)>& set);

/// Joins each option that takes an optional length with the word after it, if this word is a length
/// (a positive number, with or without unit): `--weld 1e-6u` becomes `--weld=1e-6u`. In `--weld
/// in.obj`, the next word is an argument of its own; a file whose name is a length must be given as
/// ./NAME.
std::vector<std::string> join_optional_lengths(std::vector<std::string> words);

/// Declares an option for a length; Target is Length or std::optional<Length>.
template <class Target>
CLI::Option* add_length(CLI::App& app, const std::string& name, Target& target, Length::Unit unit,
                        const std::string& help) {
  CLI::Option* option = add_parsed_option(
      app, name, "LENGTH", help,
      [&target, name, unit](const auto& text) { target = parse_length_option(name, text, unit); });
  note_units_of_length(app, *option, unit);
  return option;
}

}  // namespace ibmfair::commands
