// How many threads the library's loops use.
#pragma once

namespace ibmfair {

/// Sets the number of threads of all loops to come; 0 leaves it to the environment
/// (OMP_NUM_THREADS, else one for each core that the process may use); it is less where the address
/// space is limited and has no room for so many. Results do not depend on it. Throws BadOption for
/// a negative number or one above `largest_thread_count`.
void set_thread_count(int count);

constexpr int largest_thread_count = 1024;

/// The number of threads that a loop uses now.
int thread_count();

/// Scratch memory for the tasks of one loop: `worker_index()` within a task is below
/// `worker_count()` outside of it, and no two tasks that run at the same time have the same one.
int worker_count();
int worker_index();

/// Ends the threads that OpenBLAS starts when it is loaded, where that is the BLAS of the process;
/// from now on it works on the thread that calls it. Before they sleep, a tenth of a second after
/// the start, they spin on the cores that the loops need: a flow of 41 thousand vertices took a
/// fifth less without them. Does nothing where memory is so limited that they might never end.
void end_blas_threads();

}  // namespace ibmfair
