#include "ibmfair/base/threads.h"

#include <string>

#include <omp.h>

#include "ibmfair/base/errors.h"

extern "C" void openblas_set_num_threads(int count);

namespace ibmfair {

void set_thread_count(int count) {
  if (count < 0 || count > largest_thread_count) {
    throw BadOption("cannot use " + std::to_string(count) + " threads: give 0 (all) to " +
                    std::to_string(largest_thread_count));
  }
  openblas_set_num_threads(1);
  if (count > 0) {
    omp_set_num_threads(count);
  }
}

int thread_count() {
  return omp_get_max_threads();
}

}  // namespace ibmfair
