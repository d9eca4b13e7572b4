#include "commands/denoise_defaults.h"

#include <array>
#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/smooth_arguments.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {
namespace {

struct DefaultValue {
  const char *option, *value;
};

// More steps leave the same error (by 1 % on all of the table's meshes) and take longer; with
// fewer, what the choice of the cut-off has done for one is of no use for the next.
constexpr std::array defaults{DefaultValue{"--cutoff", "auto"},
                              DefaultValue{"--laplacian", "umbrella"},
                              DefaultValue{"--twicing", "1"}, DefaultValue{"--steps", "8"}};

/// As on a command line.
std::string words() {
  std::string text;
  for (const auto& [option, value] : defaults) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " ", option, value);
  }
  return text;
}

}  // namespace

void add_denoise_flag(CLI::App& app, SmoothArguments& arguments) {
  const auto set_defaults = [&app, &arguments](std::int64_t times) {
    arguments.denoise = times > 0;  // not for --denoise=false
    if (!arguments.denoise) {
      return;
    }
    for (const auto& [name, value] : defaults) {
      if (CLI::Option* const option = app.get_option(name); option->count() == 0) {
        option->add_result(value);  // as if it had been given: reports and jobs have it, too
      }
    }
  };
  app.add_flag_function("--denoise", set_defaults,
                        fmt::format("take noise off, however strong it is, and leave the shape: "
                                    "where these are not given otherwise, {}, and the volume of a "
                                    "closed mesh is kept",
                                    words()));
}

bool keeps_volume_of(const Topology& topology, const SmoothArguments& arguments) {
  return arguments.denoise && topology.boundary_loops.empty() && topology.orientable &&
         !arguments.max_move;
}

}  // namespace ibmfair::commands
