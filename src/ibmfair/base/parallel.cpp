#include "ibmfair/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ibmfair {

void parallel_tasks(std::int64_t count, const std::function<void(std::int64_t)>& task) {
  // While a thread waits for others here, it takes no task of a loop around this one: what it has
  // in its scratch memory stays.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t i) { task(i); }); });
}

}  // namespace ibmfair
