// How much memory the process has, and could have.
#pragma once

#include <string>

namespace ibmfair {

/// Bytes of memory that the process holds now; 0 where the system does not tell.
double resident_bytes();

/// Bytes that the process could still get without swapping: what the system has left, or the
/// control groups that the process is in (containers, batch systems), or its limit of address space
/// (ulimit -v), whichever is least; infinite where nothing tells. `root` stands before the names of
/// the system's files.
double available_bytes(const std::string& root = "");

/// Throws OutOfMemory, naming `what` and the numbers, where it needs more bytes than are available.
void require_available(double bytes, const std::string& what);

}  // namespace ibmfair
