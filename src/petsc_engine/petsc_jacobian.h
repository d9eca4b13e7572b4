// The Jacobian as a matrix that is distributed over all ranks, with PETSc's KSP as the solver.
#pragma once

#include <cstdint>
#include <vector>

#include <petscksp.h>

#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "petsc_engine/petsc_parts.h"

namespace ibmfair::petsc {

enum class LinearSolver : std::uint8_t { cg, mumps };

/// Each rank stores the rows of its unknowns. Conjugate gradients iterate until the residual is
/// below `FlowOptions::solver_tolerance` in the norm of the preconditioner, in which rows of small
/// triangles have the same weight as other rows. The preconditioner is successive over-relaxation
/// of each rank's rows, or BoomerAMG if over-relaxation would take many iterations. The options
/// `-ksp_*` and `-pc_*` override these choices.
class PetscJacobian final : public JacobianSolver {
 public:
  /// The referenced objects must outlive the solver. All members, this one included, are
  /// collective.
  PetscJacobian(const JacobianShape& shape, const PetscParts& parts, LinearSolver solver);
  ~PetscJacobian() override;

  void update(const JacobianParts& parts) override;
  void solve(const Points& B, Points& Y) override;
  void tighten(double tolerance) override;

 private:
  void number_unknowns(const PetscParts& parts);
  void make_matrix();
  void make_solver(const JacobianParts& parts);

  /// Result of setting up the preconditioner for J_; the same on all ranks.
  enum class SetUp : std::uint8_t { done, short_of_space, failed };
  SetUp set_up();

  /// Assembles row u of J: the columns (numbers of unknowns over all ranks) and their values.
  struct Row {
    std::vector<PetscInt> column;
    std::vector<PetscScalar> value;
  };
  void gather(Index u, const JacobianParts* parts, Row& row);

  const JacobianShape shape_;
  const Communicator& comm_;
  const LinearSolver solver_;
  std::vector<PetscInt> number_;  // #V, number of the unknown over all ranks; -1: fixed
  PetscInt first_ = 0;            // number of the first unknown of this rank
  std::vector<PetscInt> slot_;    // scratch, #V: position of the vertex in the row; -1: absent
  Mat J_ = nullptr;
  Vec x_ = nullptr, b_ = nullptr;
  KSP ksp_ = nullptr;
  bool factors_ = false;  // whether the preconditioner is a factorization of the whole J
};

}  // namespace ibmfair::petsc
