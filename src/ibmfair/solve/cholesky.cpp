#include "ibmfair/solve/cholesky.h"

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

void refuse_indefinite(Index unknown) {
  throw FactorizationFailed(fmt::format(
      "the Jacobian is not positive definite at unknown {}: a triangle there has (almost) no "
      "area, or a coordinate is not finite",
      unknown));
}

}  // namespace ibmfair
