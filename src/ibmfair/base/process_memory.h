// How much memory the process has, and could have.
#pragma once

#include <string>

namespace ibmfair {

/// From now on memory that is freed stays with the process, in one heap for all threads, for what
/// it needs next: to get a page from the system takes as long as to write it a few times. Of 655
/// thousand vertices the flow took 7 % less, of 2.6 million 5 %, and no more memory.
void keep_freed_memory();

/// From now on the heap grows by pages of 2 MiB, where the system has them: a page costs a fault,
/// for which some virtual machines take 12 us, and what is far apart in memory waits for the page
/// table. On such a machine the flow of 41 and 655 thousand vertices took half of the time, and no
/// more memory. Advice only. Sets address space apart, half as much as the system has memory; does
/// nothing where that is limited.
void use_large_pages();

/// Bytes of memory that the process holds now, freed ones that it keeps among them; 0 where the
/// system does not tell.
double resident_bytes();

/// The most that it has held.
double peak_resident_bytes();

/// Bytes that the process could still get without swapping: what the system has left, or the
/// control groups that the process is in (containers, batch systems), or its limits of address
/// space and data (ulimit -v, -d), whichever is least; infinite where nothing tells. `root` stands
/// before the names of the system's files.
double available_bytes(const std::string& root = "");

/// The lower of the limits of address space and of data (ulimit -v, -d) in bytes; infinite where
/// there is none.
double address_space_limit();

/// Whether so many bytes are available. A few always are: not worth a look at what the system has.
bool is_available(double bytes);

/// Throws OutOfMemory, naming `what` and the numbers, where it needs more bytes than are available.
void require_available(double bytes, const std::string& what);

}  // namespace ibmfair
