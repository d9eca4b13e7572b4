// The Jacobian assembled and factored.
#pragma once

#include <optional>

#include "ibmfair/flow/jacobian_solver.h"
#include "ibmfair/solve/cholesky.h"

namespace ibmfair {

/// J is inexact by design ([W07] section 3.2), so float32 does for its factor as long as solves are
/// good to a part in a thousand; where they are not, float64 takes over.
class DirectJacobian final : public JacobianSolver {
 public:
  explicit DirectJacobian(const JacobianShape& shape);

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;

 private:
  void assemble(const JacobianParts& parts);
  void factor(Precision precision);

  const JacobianShape shape_;
  HessianAssembler assembler_;
  SymmetricMatrix J_;
  Precision precision_ = Precision::float32;
  bool tried_ = false;  // the factor has solved well
  std::optional<SymbolicCholesky> symbolic_;
  std::optional<CholeskyFactor> factor_;
  std::optional<CholeskySolver> solver_;
};

}  // namespace ibmfair
