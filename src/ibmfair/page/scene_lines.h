// The lines that tell a mesh's parts apart.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/page/scene.h"

namespace ibmfair {

/// The rim of every hole, and the outer borders.
std::vector<SceneLine> hole_lines(const Points& X, const std::vector<Hole>& holes);

/// The rim of a hole where a patch meets it.
SceneLine seam_line(const Points& X, const Hole& hole);

/// Triangles that carry no energy, and edges of three or more triangles; of each kind of defect the
/// first thousand.
std::vector<SceneLine> defect_outlines(const Points& X, const Topology& topology);

/// The edges between held vertices (`held` is #V) that border on a triangle with a free one, joined
/// to strips.
std::vector<SceneLine> held_lines(const Points& X, const Topology& topology,
                                  const std::vector<std::uint8_t>& held);

}  // namespace ibmfair
