// [W07] Figure 7: what the two bending models cost, and what a time step with them does.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "cloth/scenes.h"

namespace ibmfair::cloth {

/// The gradient and the Hessian are those of bending alone; the Hessian's cost is that of adding it
/// to the Hessian of the sheet. An implicit step is one iteration of Newton's method: linearise,
/// factor, solve, and search along the line; what factoring and solving take of it comes last.
inline constexpr std::array<std::string_view, 5> timed_quantities{
    "gradient", "Hessian", "explicit step", "implicit step", "factor, solve"};

/// Milliseconds of processor time of each of them.
using Costs = std::array<double, timed_quantities.size()>;

/// Of each row of bending_forces(), the models taking turns: the shortest of several batches of at
/// least `seconds` each.
std::vector<Costs> measure_costs(const SceneRow& row, const TriangleMesh& sheet, double seconds);

/// Measures on one thread and prints the table to standard output, beside the figures of the paper.
/// `quick` leaves the two finer resolutions out.
void print_timing_table(bool quick);

}  // namespace ibmfair::cloth
