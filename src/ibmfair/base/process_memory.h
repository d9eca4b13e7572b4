// How much memory the process has, and could have.
#pragma once

namespace ibmfair {

/// Bytes of memory that the process holds now; 0 where the system does not tell.
double resident_bytes();

/// Bytes that the system could still give without swapping; infinite where it does not tell.
double available_bytes();

}  // namespace ibmfair
