// Escapes text so that a terminal displays it and does not interpret any part as a command.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// The length in bytes of the UTF-8 character at the start of the text, which must not be empty.
/// Returns 0 if the character must not be sent to a terminal: for a control character (escape
/// sequences begin with one), a character that changes the direction of writing, or a byte that is
/// not UTF-8.
std::size_t visible_length(std::string_view text);

/// Whether all characters of the text have a visible length.
bool is_printable(std::string_view text);

/// The escaped form of a byte, as `\n`, `\t` or `\x1b`.
std::string escaped_byte(char byte);

/// The text with all bytes of invisible characters escaped. For messages that contain file names or
/// parts of files, which may contain any bytes.
std::string printable(std::string_view text);

/// JSON (in UTF-8) with all invisible characters but line feeds escaped as in `\u009b`. The meaning
/// of the JSON is unchanged.
std::string printable_json(std::string_view json);

}  // namespace ibmfair::commands
