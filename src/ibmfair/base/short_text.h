// Text from a file, shortened for messages.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace ibmfair {

/// The first `longest` bytes of the text; control characters, which a terminal might obey, become
/// '?'.
inline std::string short_text(std::string_view text, std::size_t longest = 200) {
  std::string result(text.substr(0, longest));
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  std::replace_if(result.begin(), result.end(), is_control, '?');
  return result;
}

}  // namespace ibmfair
