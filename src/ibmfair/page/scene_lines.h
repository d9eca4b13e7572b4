// Lines that separate the parts of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/fill/holes.h"
#include "ibmfair/page/scene.h"

namespace ibmfair {

/// The boundary of every hole, and the outer boundaries.
std::vector<SceneLine> hole_lines(const Points& X, const std::vector<Hole>& holes);

/// The boundary of a hole, along which the patch meets the mesh.
SceneLine seam_line(const Points& X, const Hole& hole);

/// The outlines of defects: triangles that carry no energy, and edges with three or more triangles.
/// Of each kind of defect only the first thousand are returned.
std::vector<SceneLine> defect_outlines(const Points& X, const Topology& topology);

/// The edges between two fixed vertices (flags `fixed`, #V) that bound a triangle with a free
/// vertex, joined to strips.
std::vector<SceneLine> fixed_lines(const Points& X, const Topology& topology,
                                   const std::vector<std::uint8_t>& fixed);

}  // namespace ibmfair
