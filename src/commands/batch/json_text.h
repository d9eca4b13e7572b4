// JSON that people write.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace ibmfair::commands {

/// Parses a text with `//` and `/* */` comments allowed. Throws BadFile that starts with
/// `NAME:LINE:COLUMN:` for a syntax error, one that names the key where an object has it twice, and
/// one for values nested so deeply that looking at them could exhaust the stack.
nlohmann::ordered_json parse_json_text(std::string_view text, const std::string& name);

/// A value as a message shows it: its first few characters.
std::string shown(const nlohmann::ordered_json& value);

}  // namespace ibmfair::commands
