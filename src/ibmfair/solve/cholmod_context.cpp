#include "ibmfair/solve/cholmod_context.h"

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

CholmodContext::CholmodContext() {
  cholmod_l_start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;  // statuses become exceptions in check()
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.quick_return_if_not_posdef = 1;
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

cholmod_sparse view(const SymmetricMatrix& J) {
  cholmod_sparse A{};
  A.nrow = A.ncol = static_cast<std::size_t>(J.size());
  A.nzmax = J.row.size();
  A.p = const_cast<std::int64_t*>(J.column_first.data());
  A.i = const_cast<std::int64_t*>(J.row.data());
  A.x = const_cast<double*>(J.value.data());
  A.stype = -1;  // the lower triangle is stored
  A.itype = CHOLMOD_LONG;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  return A;
}

}  // namespace ibmfair
