// Zip archives for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ibmfair::test {

/// A zip archive of these entries (names and contents), compressed by deflate or stored. With
/// `zip64`, sizes and offsets are in the fields for large archives.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& entries,
                   bool deflate = true, bool zip64 = false);

}  // namespace ibmfair::test
