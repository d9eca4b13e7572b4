// How many vertices the patch of a group of holes may get, how far it may reach, and where it
// starts.
#pragma once

#include <vector>

#include "ibmfair/fill/hole_filler.h"
#include "ibmfair/fill/patch_fairing.h"

namespace ibmfair {

/// The limits for a group that has been cut (`FilledGroup::plain` exists). `bridges`: for each hole
/// the other end of its bridge, or -1.
PatchLimits limits_of(const FilledGroup& group, const std::vector<Index>& bridges,
                      const FillOptions& options);

}  // namespace ibmfair
