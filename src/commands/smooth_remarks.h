// What a run of `smooth` tells its user beside the results: how it ended, and what may surprise.
#pragma once

#include <string>
#include <vector>

#include "commands/exit_code.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"

namespace ibmfair::commands {

/// Remarks about texture coordinates that shift, about noise that is not independent from vertex to
/// vertex, or hardly known, about triangles that share no vertices, about rims of thin walls that
/// stay, and about a default cut-off that is longer than the mesh is large.
std::vector<std::string> notes_on(const SmoothArguments& arguments, const SmoothResult& result);

/// A warning with the cause and what helps if the volume of a closed mesh has changed by more than
/// 1 %; else empty.
std::string warning_on_volume(const SmoothArguments& arguments, const SmoothResult& result);

/// A warning with what helps if the walls of a mesh have become thicker or thinner by more than a
/// tenth (the median), unless warning_on_volume says so; else empty.
std::string warning_on_walls(const SmoothArguments& arguments, const SmoothResult& result);

/// A warning if the flow did not end as requested; else empty. The final state of the flow is in
/// the file `output`.
std::string warning_on_end(const SmoothArguments& arguments, const SmoothResult& result,
                           const std::string& output);

ExitCode exit_code_of(const SmoothResult& result);

}  // namespace ibmfair::commands
