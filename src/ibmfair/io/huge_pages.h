// Large buffers in large pages.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Asks the kernel to back a buffer of many megabytes, not yet touched, with pages of 2 MiB:
/// filling it then costs five hundred times fewer page faults, which are a third of the time of
/// reading a file. Advice only: nothing depends on its being taken.
void advise_huge_pages(void* start, std::size_t bytes);

/// Sizes mesh.X for `vertices` and reserves memory for faces, in large pages. Memory that stays
/// untouched costs nothing.
void make_room(Mesh& mesh, std::int64_t vertices, std::int64_t faces, std::int64_t corners);

}  // namespace ibmfair
