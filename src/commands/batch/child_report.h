// What a run tells of itself, cut down to what fits a line of a table.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace ibmfair::commands {

/// The first error in what a run said on standard error; else the first warning; else nothing.
/// Without the program's name before it.
std::string first_message(std::string_view err);

/// The report that a run printed as a flat object: `{"after": {"energy": 1}}` gives
/// `{"after.energy": 1}`. Leaves out lists, times, options, and what a table has columns for.
/// An empty object where the text is no report.
nlohmann::ordered_json main_figures(std::string_view out);

}  // namespace ibmfair::commands
