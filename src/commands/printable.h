// Text that a terminal shows instead of obeying.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ibmfair::commands {

/// The length of the UTF-8 character that the text starts with; 0 where it must not reach a
/// terminal as it is: a control character (escape sequences begin with one), a character that turns
/// the direction of writing, or a byte that is no UTF-8. `text` is not empty.
std::size_t visible_length(std::string_view text);

/// Whether all of it is visible.
bool is_printable(std::string_view text);

/// The byte as `\n`, `\t` or `\x1b`.
std::string escaped_byte(char byte);

/// The text with every byte escaped that is not visible. What names of files and their contents put
/// into messages may hold anything.
std::string printable(std::string_view text);

/// JSON, which is UTF-8 and whose line feeds are its own, with the other such characters escaped in
/// its way, as `\u009b`: it means the same.
std::string printable_json(std::string_view json);

}  // namespace ibmfair::commands
