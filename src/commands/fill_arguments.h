// The command-line arguments of `fill`.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "commands/length.h"
#include "commands/picture.h"
#include "commands/shared_options.h"
#include "ibmfair/fill/fill_holes.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

struct FillArguments {
  std::string input;
  InputOptions reading;
  OutputOptions output;
  ReportOptions report;
  bool strict = false;
  bool allow_intersections = false;
  PictureOptions picture;

  bool stitch = false;                 ///< close cracks first
  std::optional<Length> stitch_reach;  ///< how far apart the sides of a crack may be
  HoleChoice choice;
  std::optional<Length> max_perimeter, max_diameter, edge_length;
  FillOptions fill;
  std::string continuity = "2";  ///< "0", "1" or "2"
  bool no_fair = false, no_refine = false;
  std::function<bool()> laplacian_is_given;  ///< by an option, once the options are parsed
  std::optional<double> keep_sharp;          ///< degrees
  MassOptions mass;
  std::string region;
  std::string tangential = "none";
};

/// Declares the arguments and options; their values are stored in `a`.
void add_fill_arguments(CLI::App& app, FillArguments& a);

/// The meaning of `a.continuity`.
Continuity continuity_of(const FillArguments& a);

/// Throws BadOption for options that exclude each other because of their values.
void check_fill_arguments(const FillArguments& a);

}  // namespace ibmfair::commands
