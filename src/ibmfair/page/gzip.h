// Compresses bytes and encodes them as text for a web page.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair {

/// The output of `gzip -n`: without name and time, so that equal input gives equal output. Throws
/// std::bad_alloc if memory runs out.
std::string gzip(std::string_view bytes);

/// Base64 of RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace ibmfair
