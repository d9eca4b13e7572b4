#include "ibmfair/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ibmfair {

void parallel_tasks(std::int64_t count, const std::function<void(std::int64_t)>& task) {
  // isolate: while this thread waits here for other threads, it must not start a task of an
  // enclosing loop, because that task would overwrite the scratch memory that this thread still
  // uses.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t i) { task(i); }); });
}

}  // namespace ibmfair
