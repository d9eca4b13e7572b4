// What a person is told about places where the mesh is not a surface.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "commands/console.h"
#include "commands/report/report.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// One warning for each kind of defect: how many, and the first few by number (counted from 0).
/// With `strict`, throws BadMesh with the same text instead.
void warn_of_defects(const Topology& topology, bool strict, const Console& console);

/// The warnings for a report, each with the first hundred of its elements one by one.
std::vector<Warning> defect_list(const Points& X, const Topology& topology);

/// The texts of the warnings, one for each kind of defect, without the consequences.
std::vector<std::string> defect_lines(const Topology& topology);

/// Throws BadMesh that names all defects, if there are any.
void require_no_defects(const Topology& topology);

/// All defects by number, for a report.
nlohmann::ordered_json defects_json(const Topology& topology);

}  // namespace ibmfair::commands
