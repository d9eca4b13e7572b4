// The line ends of a text.
#pragma once

#include <string_view>

namespace ibmfair {

/// The line end at the start of the text: "\r\n", "\n" or "\r"; empty if there is none.
inline std::string_view leading_line_end(std::string_view text) {
  if (text.starts_with("\r\n")) return text.substr(0, 2);
  return text.starts_with('\r') || text.starts_with('\n') ? text.substr(0, 1) : std::string_view();
}

/// The first line end in the text; "\n" if there is none.
inline std::string_view first_line_end(std::string_view text) {
  const std::size_t at = text.find_first_of("\r\n");
  return at == std::string_view::npos ? std::string_view("\n") : leading_line_end(text.substr(at));
}

}  // namespace ibmfair
