// JSON that is written by hand: parsing with comments and error positions.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace ibmfair::commands {

/// Parses a text in which `//` and `/* */` comments are allowed. Throws BadFile: for a syntax error
/// with a message that starts with `NAME:LINE:COLUMN:`, for an object that has a key twice with a
/// message that names the key, and for values nested so deeply that recursion could exhaust the
/// stack.
nlohmann::ordered_json parse_json_text(std::string_view text, const std::string& name);

/// The first few characters of a value, for messages.
std::string shown(const nlohmann::ordered_json& value);

}  // namespace ibmfair::commands
