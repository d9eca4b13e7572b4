// The picture of a run of `fill`: the mesh before and after. Nothing is drawn if no picture was
// requested.
#pragma once

#include "commands/fill_arguments.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// Looks straight onto the patch with the largest area, from outside; at the whole mesh if there is
/// no patch. `X`, `topology`: the mesh that was read; `filled_X`, `filled_topology`: with patches.
void draw_filling(const FillArguments& arguments, const Points& X, const Topology& topology,
                  const Filling& filling, const Points& filled_X, const Topology& filled_topology);

/// Looks at the whole mesh, whose vertices move from `before` to `after`.
void draw_region(const FillArguments& arguments, const Points& before, const Topology& topology,
                 const Points& after);

}  // namespace ibmfair::commands
