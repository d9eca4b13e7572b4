// What a run of smooth says about its cut-off, and about the choice of the cut-off.
#pragma once

#include <string>

#include "commands/report/report_formats.h"
#include "commands/smooth_plan.h"

namespace ibmfair::commands {

/// A length in the mesh's units and in mean edge lengths.
std::string length_text(double length, double edge);

/// Lines with the cut-off and, if it was chosen automatically, the noise that it was chosen from
/// and the error that it leaves. If `detailed`, also all cut-offs that were tried.
std::string cutoff_lines(const SmoothPlan& plan, bool detailed);

/// Adds to the report how the cut-off was chosen, if it was chosen automatically.
void add_cutoff_choice(const SmoothPlan& plan, Report& report);

}  // namespace ibmfair::commands
