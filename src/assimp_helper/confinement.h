// The rights that the importing process gives up before it reads the first byte of the file.
#pragma once

#include <cstdint>

namespace ibmfair {

/// Limits the CPU time (seconds) and the address space (bytes) of this process, forbids it to write
/// files, start processes or dump core, and lets the kernel kill it when its parent process ends.
/// Limits that are already tighter are kept.
void limit_resources(std::uint64_t cpu_seconds, std::uint64_t address_space);

/// If the kernel supports Landlock (Linux 5.13 and later), forbids this process to open anything
/// but files below `folder` (a descriptor; negative: no files at all), to write, to run programs,
/// to connect, and to signal other processes. The restrictions hold even if a malicious file has
/// gained control of the importer.
void confine_to(int folder);

}  // namespace ibmfair
