// Names of files that are made from the name of another.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair::commands {

/// Puts the parts of `input` in place of `{name}` (without folders), `{stem}` (without extension,
/// too), `{ext}` (without its dot) and `{dir}` (the folders; `.` where there are none). `{{` and
/// `}}` are braces. A pattern that ends in `/` means `{name}` in that folder. Throws BadOption for
/// any other use of braces.
std::string expand_pattern(std::string_view pattern, const std::string& input);

/// The pattern that expands to this text.
std::string literal_pattern(std::string_view text);

}  // namespace ibmfair::commands
