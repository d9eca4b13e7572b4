// How many threads the library's loops use.
#pragma once

namespace ibmfair {

/// Sets the number of threads of all loops to come; 0 leaves it to OpenMP (OMP_NUM_THREADS, else
/// one a core). Results do not depend on it. BLAS is held at one thread whatever the number: its
/// threaded kernels split sums differently from count to count.
/// Throws BadOption for a negative number or one above `largest_thread_count`.
void set_thread_count(int count);

constexpr int largest_thread_count = 1024;

/// The number of threads that a loop uses now.
int thread_count();

}  // namespace ibmfair
