#include "ibmfair/solve/cholmod_context.h"

#include <cstdint>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

CholmodContext::CholmodContext() {
  cholmod_l_start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;  // statuses become exceptions in check()
  common_.supernodal = CHOLMOD_SUPERNODAL;
}

CholmodContext::~CholmodContext() {
  cholmod_l_finish(&common_);
}

void CholmodContext::check(const char* stage) const {
  switch (common_.status) {
    case CHOLMOD_OK:
      return;
    case CHOLMOD_OUT_OF_MEMORY:
      throw OutOfMemory(fmt::format("out of memory in the sparse {}", stage));
    case CHOLMOD_TOO_LARGE:
      throw OutOfMemory(fmt::format("the sparse {} is larger than its index type", stage));
    default:
      throw FactorizationFailed(fmt::format("the sparse {} failed (CHOLMOD status {})", stage,
                                            static_cast<int>(common_.status)));
  }
}

}  // namespace ibmfair
