// Patterns that make an output file name from the name of the input file.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair::commands {

/// Replaces `{name}` by the file name of `input` without folders, `{stem}` by the file name without
/// folders and extension, `{ext}` by the extension without its dot, and `{dir}` by the folders (`.`
/// if there are none). `{{` and `}}` stand for single braces. A pattern that ends in `/` means
/// `{name}` in that folder. Throws BadOption for any other use of braces.
std::string expand_pattern(std::string_view pattern, const std::string& input);

/// The pattern that expands to this text.
std::string literal_pattern(std::string_view text);

}  // namespace ibmfair::commands
