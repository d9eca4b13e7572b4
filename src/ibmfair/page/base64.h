// Encodes bytes as text for a web page.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair {

/// Base64 of RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace ibmfair
