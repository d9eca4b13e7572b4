#include "commands/denoise_defaults.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/smooth_arguments.h"

namespace ibmfair::commands {
namespace {

struct DefaultValue {
  const char *option, *value, *with_creases;
};

constexpr const char* crease_laplacian = "crouzeix-raviart";  // only this one keeps creases
constexpr const char* round_laplacian = "lagrange";

// With more steps the error is the same (within 1 % on all meshes of the table) and the run takes
// longer. With fewer steps, the choice of the cut-off cannot continue the flow of one trial for the
// next trial.
constexpr std::array defaults{DefaultValue{"--cutoff", "auto", "auto"},
                              DefaultValue{"--laplacian", "umbrella", crease_laplacian},
                              DefaultValue{"--twicing", "1", "0"},
                              DefaultValue{"--steps", "8", "8"},
                              DefaultValue{"--boundary", "fair", "fair"},
                              DefaultValue{"--first-stage", "normals", "normals"}};

using Value = const char* DefaultValue::*;

/// The options with the values of a column, as on a command line in lines that fit into a terminal.
/// If `other` is given, only the options for which the columns differ.
std::string words(Value value, Value other = nullptr) {
  constexpr std::size_t width = 72;
  std::string text;
  std::size_t line = 0;  // where the last line begins
  for (const DefaultValue& set : defaults) {
    if (other == nullptr || std::string_view(set.*value) != set.*other) {
      const std::string word = fmt::format("{} {}", set.option, set.*value);
      if (text.size() - line + word.size() >= width) {
        text += "\n ";
        line = text.size();
      }
      text += (text.empty() ? "" : " ") + word;
    }
  }
  return text;
}

/// Whether the option is given with another value than --denoise would give it. Jobs name all
/// values, and mean the same as the command line from which they came.
bool is_changed(const CLI::App& app, const std::string& name) {
  const auto set = std::ranges::find_if(
      defaults, [&](const DefaultValue& value) { return name == value.option; });
  return is_given(app, name.c_str()) &&
         app.get_option(name)->results() != std::vector<std::string>{set->value};
}

}  // namespace

void add_denoise_flag(CLI::App& app, SmoothArguments& arguments) {
  const auto set_defaults = [&app, &arguments](std::int64_t times) {
    arguments.denoise = times > 0;  // false for --denoise=false
    if (!arguments.denoise) {
      return;
    }
    const bool keeps_sharp = is_given(app, "--keep-sharp");
    arguments.finds_creases = !keeps_sharp && !is_given(app, "--mass");
    for (const char* const option : {"--cutoff", "--laplacian", "--twicing"}) {
      arguments.finds_creases = arguments.finds_creases && !is_changed(app, option);
    }
    arguments.chooses_steps = !is_changed(app, "--steps");
    arguments.chooses_boundary = !is_changed(app, "--boundary");
    for (const auto& [name, value, with_creases] : defaults) {
      if (!is_given(app, name)) {  // set as if given, so that reports and jobs contain the value
        app.get_option(name)->add_result(keeps_sharp ? with_creases : value);
      }
    }
  };
  app.add_flag_function(
      "--denoise", set_defaults,
      "remove noise of any strength, and keep the shape, its volume and its sharp "
      "edges (see Denoising below)");
}

std::string denoising_text() {
  return fmt::format(
      "--denoise is shorthand for these options; each of them can be overridden:\n"
      "  {}\n"
      "Unless --max-move is given, it also keeps the volume of a closed mesh, and\n"
      "moves outliers first: vertices far off the surface that the others form.\n"
      "If sharp edges are found (they are looked for unless --keep-sharp, --mass, or\n"
      "other values of --cutoff, --laplacian or --twicing are given), it uses these\n"
      "instead:\n"
      "  {} --keep-sharp ANGLE\n"
      "with the angle that leaves the least error. Steps of voxels or of rounded\n"
      "coordinates are smoothed by the default cut-off, or by less and keeping sharp\n"
      "edges if it would move vertices further than the steps explain. Where there\n"
      "are no sharp edges and this leaves less error, it uses\n"
      "  --laplacian {}\n"
      "An outline that is more jagged than the noise keeps most of its shape.\n",
      words(&DefaultValue::value), words(&DefaultValue::with_creases, &DefaultValue::value),
      round_laplacian);
}

void keep_creases(FlowOptions& options) {
  options.laplacian = crease_laplacian;
  options.twicing = 0;
}

void suit_round_shapes(FlowOptions& options) {
  options.laplacian = round_laplacian;
}

}  // namespace ibmfair::commands
