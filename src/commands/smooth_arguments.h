// The command-line arguments of `smooth`.
#pragma once

#include <optional>
#include <string>

#include "commands/length.h"
#include "commands/picture.h"
#include "commands/shared_options.h"
#include "ibmfair/flow/flow_options.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

struct SmoothArguments {
  std::string input;
  InputOptions reading;
  OutputOptions output;
  ReportOptions report;
  bool strict = false;
  PictureOptions picture;
  std::string checkpoint;

  std::string engine;
  bool denoise = false;
  bool finds_creases = false;     // with --denoise: find creases, and keep them
  bool chooses_boundary = false;  // with --denoise: fix open boundaries if the noise is steps
  bool chooses_steps = false;  // with --denoise: take the number of time steps that suits the noise
  FlowOptions flow;            // `steps` and `solver_tolerance` are resolved later:
  std::optional<int> steps;    // see commands/smooth_defaults.h
  std::optional<double> solver_tolerance;  // relative to the initial residual
  std::optional<double> time_step;
  std::optional<Length> cutoff;
  bool cutoff_auto = false;  // chosen from the noise of the mesh
  std::optional<Length> max_move;
  std::vector<double> anisotropy;    // X, Y, Z, FACTOR; or empty
  std::optional<double> keep_sharp;  // degrees
  bool plain = false, dry_run = false;
  MassOptions mass;
  std::string metric = "mass", boundary = "fixed", tangential, first_stage = "flow";
  std::string fix_file, mask, weights, h0;
};

/// Declares the arguments and options; their values are stored in `a`.
void add_smooth_arguments(CLI::App& app, SmoothArguments& a);

}  // namespace ibmfair::commands
