// Bytes in the fewest characters that a page can hold.
#pragma once

#include <string>
#include <string_view>

namespace ibmfair {

/// As `gzip -n` makes them: without name and time, so that equal bytes give equal ones. Throws
/// std::bad_alloc where memory runs out.
std::string gzip(std::string_view bytes);

/// RFC 4648, with padding, in one line.
std::string base64(std::string_view bytes);

}  // namespace ibmfair
