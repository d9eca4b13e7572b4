// Extracts, from the output of a run, the message and the figures for one line of a table.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace ibmfair::commands {

/// The first error message in `err`, the standard error output of a run; without errors, the first
/// warning; without warnings, an empty string. The program's name in front is removed.
std::string first_message(std::string_view err);

/// The JSON report that a run printed, as a flat object: `{"after": {"energy": 1}}` gives
/// `{"after.energy": 1}`. Lists, times, options, and fields that have their own column in a table
/// are left out. Returns an empty object if the text is not a report.
nlohmann::ordered_json main_figures(std::string_view out);

}  // namespace ibmfair::commands
