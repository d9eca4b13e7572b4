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
}

CholmodContext::~CholmodContext() {
  cholmod_l_finish(&common_);
}

void CholmodContext::check() const {
  switch (common_.status) {
    case CHOLMOD_OK:
      return;
    case CHOLMOD_OUT_OF_MEMORY:
      throw OutOfMemory("out of memory in the sparse analysis");
    case CHOLMOD_TOO_LARGE:
      throw OutOfMemory("the sparse analysis is larger than its index type");
    default:
      throw FactorizationFailed(fmt::format("the sparse analysis failed (CHOLMOD status {})",
                                            static_cast<int>(common_.status)));
  }
}

}  // namespace ibmfair
