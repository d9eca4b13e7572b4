// How many threads the library's loops use.
#pragma once

namespace ibmfair {

/// Sets the number of threads of all later loops. 0 means the number from OMP_NUM_THREADS, or, if
/// that is unset, one thread for each core that the process may use. The number is reduced if the
/// address space is limited and has no room for so many threads. Results do not depend on the
/// number. Throws BadOption for a negative number or one above `largest_thread_count`.
void set_thread_count(int count);

constexpr int largest_thread_count = 1024;

/// The number of threads that a loop uses now.
int thread_count();

/// Indices for scratch memory of the tasks of one loop: within a task, `worker_index()` is less
/// than the `worker_count()` obtained outside the loop, and tasks that run at the same time have
/// different indices.
int worker_count();
int worker_index();

}  // namespace ibmfair
