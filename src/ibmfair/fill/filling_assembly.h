// Puts the patches of all holes together, and replaces those that intersect what they should not.
#pragma once

#include <vector>

#include "ibmfair/fill/hole_filler.h"

namespace ibmfair {

/// The filling without `Filling::patches`, with its intersections counted. Holes whose patch
/// intersects the mesh, itself or another patch are filled by other methods, unless the
/// triangulated polygon intersects, too. `others`: a report for each hole, which the reports of
/// `groups` replace.
Filling assemble_without_intersections(const Points& X, const Topology& topology,
                                       const std::vector<HoleReport>& others,
                                       const HoleFiller& filler, std::vector<FilledGroup>& groups);

}  // namespace ibmfair
