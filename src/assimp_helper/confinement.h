// What the importing process gives up before it looks at a byte of the file.
#pragma once

#include <cstdint>

namespace ibmfair {

/// Lets the process take this much time and address space, write no file, start no process and
/// leave no core behind, and end with the one that started it. Limits that are tighter already
/// stay.
void limit_resources(std::uint64_t cpu_seconds, std::uint64_t address_space);

/// Where the kernel can (Linux 5.13 and later, by Landlock), forbids the process to open anything
/// but files below `folder` (a descriptor; negative: none), to write, to run programs, to connect
/// and to signal others. This holds even for an importer that the file has taken over.
void confine_to(int folder);

}  // namespace ibmfair
