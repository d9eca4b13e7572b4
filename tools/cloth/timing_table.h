// [W07] Figure 7: the costs of the two bending models and of a time step with each of them.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "cloth/scenes.h"

namespace ibmfair::cloth {

/// The gradient and the Hessian are those of bending alone; the Hessian's cost is that of adding it
/// to the Hessian of the sheet. An implicit step is one iteration of Newton's method: linearise,
/// factor, solve, and search along the line; the time of factoring and solving alone comes last.
inline constexpr std::array<std::string_view, 5> timed_quantities{
    "gradient", "Hessian", "explicit step", "implicit step", "factor, solve"};

/// Milliseconds of processor time of each quantity.
using Costs = std::array<double, timed_quantities.size()>;

/// For each row of bending_forces(), measured in turn: the shortest of several batches of at
/// least `seconds` each.
std::vector<Costs> measure_costs(const SceneRow& row, const TriangleMesh& sheet, double seconds);

/// Measures on one thread and prints the table to standard output, beside the figures of the paper.
/// `quick` leaves the two finer resolutions out.
void print_timing_table(bool quick);

}  // namespace ibmfair::cloth
