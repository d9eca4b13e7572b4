// The lines at which three or more sheets of a mesh meet, as the interfaces of a label map do.
// Their vertices carry no bending energy and are fixed in the flow; before it, the lines are faired
// along themselves (flow/passes/curve_flow.h), so that the sheets meet in a smooth line.
#pragma once

#include <vector>

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// A closed or open polyline of edges that belong to three or more triangles each.
struct MeetingLine {
  std::vector<Index> vertices;  ///< in order; a closed line names each vertex once
  bool closed = false;
};

/// The lines of a mesh. They end where other than two such edges meet, at open boundaries, and at
/// triangles that are defects of another kind. Edges of triangles that lie over each other belong
/// to no line.
std::vector<MeetingLine> find_meeting_lines(const Topology& topology);

/// Fairs the lines up to the wavelength `cutoff` (length). `cutoff_factor` (#V or empty for 1
/// everywhere) is a factor of the cut-off at each vertex; 0 fixes the vertex. The ends of open
/// lines stay, and no vertex moves by more than `max_move` (length, or infinite). No hinge folds
/// over that was not folded before: vertices near new foldovers move less.
void fair_meeting_lines(const std::vector<MeetingLine>& lines, const Topology& topology,
                        double cutoff, const Eigen::VectorXd& cutoff_factor, double max_move,
                        Points& X);

}  // namespace ibmfair
