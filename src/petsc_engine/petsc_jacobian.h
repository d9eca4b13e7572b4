// The Jacobian as a matrix over all ranks, solved with by PETSc's KSP.
#pragma once

#include <cstdint>
#include <vector>

#include <petscksp.h>

#include "ibmfair/flow/jacobian_solver.h"
#include "petsc_engine/petsc_parts.h"

namespace ibmfair::petsc {

/// Each rank has the rows of its unknowns. Conjugate gradients go to
/// `FlowOptions::solver_tolerance`, in the norm of the preconditioner, in which the rows of small
/// triangles count as others do. That is successive over-relaxation of each rank's rows, or
/// BoomerAMG where it would take many iterations. The options `-ksp_*` and `-pc_*` say otherwise.
class PetscJacobian final : public JacobianSolver {
 public:
  /// What is referred to outlives it. Collective, as all members are.
  PetscJacobian(const JacobianShape& shape, const PetscParts& parts, LinearSolver solver);
  ~PetscJacobian() override;

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;
  void tighten(double tolerance) override;

 private:
  void number_unknowns(const PetscParts& parts);
  void make_matrix();
  void make_solver(const JacobianParts& parts);

  /// Of the preconditioner for J_, the same on all ranks.
  enum class SetUp : std::uint8_t { done, short_of_space, failed };
  SetUp set_up();

  /// Gathers row u of J: the unknowns of all ranks in it, and their values.
  struct Row {
    std::vector<PetscInt> column;
    std::vector<PetscScalar> value;
  };
  void gather(Index u, const JacobianParts* parts, Row& row);

  const JacobianShape shape_;
  const Communicator& comm_;
  const LinearSolver solver_;
  std::vector<PetscInt> number_;  // #V, of the unknowns of all ranks; -1: held
  PetscInt first_ = 0;            // number of this rank's first unknown
  std::vector<PetscInt> slot_;    // scratch, #V: where a row has the vertex
  Mat J_ = nullptr;
  Vec x_ = nullptr, b_ = nullptr;
  KSP ksp_ = nullptr;
  bool factors_ = false;  // the preconditioner is a factor of all of J
};

}  // namespace ibmfair::petsc
