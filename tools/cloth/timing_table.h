// [W07] Figure 7: what the two bending models cost, and what a time step with them does.
#pragma once

#include <string>

#include "cloth/scenes.h"

namespace ibmfair::cloth {

/// Milliseconds of each kind of work with one bending model.
struct Costs {
  double gradient = 0;
  double hessian = 0;
  double explicit_step = 0;
  double implicit_step = 0;
};

/// The shortest of several batches of at least `seconds` each. The gradient and the Hessian are
/// those of bending alone; the Hessian's cost is that of adding it to the Hessian of the sheet. An
/// implicit step is one iteration of Newton's method: linearise, factor, solve, and search along
/// the line.
Costs measure_costs(const SceneRow& row, const TriangleMesh& sheet, const BendingForce& bending,
                    double seconds);

/// Measures on one thread and prints the table to standard output, beside the ratios of the paper.
/// `quick` leaves the two finer resolutions out.
void print_timing_table(bool quick);

}  // namespace ibmfair::cloth
