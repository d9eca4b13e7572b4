// Warnings about defects: places where the mesh is not a surface.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "commands/console.h"
#include "commands/report/report.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// Prints one warning for each kind of defect, with the count and the numbers of the first few
/// elements (counted from 0). If `strict`, throws BadMesh with this text instead.
void warn_of_defects(const Topology& topology, bool strict, const Console& console);

/// The warnings for a report: one for each kind of defect, followed by one for each of its first
/// hundred elements.
std::vector<Warning> defect_list(const Points& X, const Topology& topology);

/// The texts of the warnings, one for each kind of defect, without the sentence about consequences.
std::vector<std::string> defect_lines(const Topology& topology);

/// Throws BadMesh that names all defects, if there are any.
void require_no_defects(const Topology& topology);

/// The numbers of all defect elements (edges as pairs of vertices), for a report.
nlohmann::ordered_json defects_json(const Topology& topology);

}  // namespace ibmfair::commands
