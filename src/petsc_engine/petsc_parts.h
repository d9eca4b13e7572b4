// The other ranks' parts of the mesh, as the flow asks for them.
#pragma once

#include <petscsf.h>

#include "ibmfair/flow/mesh_parts.h"
#include "petsc_engine/mesh_piece.h"

namespace ibmfair::petsc {

enum class LinearSolver : std::uint8_t { cg, mumps };

class PetscParts final : public MeshParts {
 public:
  /// Both outlive it. Collective, as all members are.
  PetscParts(const Communicator& comm, const MeshPiece& piece);
  ~PetscParts() override;
  PetscParts(const PetscParts&) = delete;
  PetscParts& operator=(const PetscParts&) = delete;

  double sum(double x) const override { return comm_.sum(x); }
  double max(double x) const override { return comm_.max(x); }
  void refresh(Points& rows) const override;
  std::unique_ptr<JacobianSolver> make_solver(const JacobianShape& shape) const override;

  /// Solvers made from here on factor, or iterate.
  void set_solver(LinearSolver solver) { solver_ = solver; }

  using MeshParts::refresh;
  /// Numbers (#V) of vertices that belong to other parts, from them.
  void refresh(std::vector<PetscInt>& values) const;

  const Communicator& communicator() const { return comm_; }

 private:
  void broadcast(MPI_Datatype unit, void* data) const;

  const Communicator& comm_;
  LinearSolver solver_ = LinearSolver::cg;
  PetscSF forest_ = nullptr;  // roots are a rank's own vertices, leaves the others that it has
  MPI_Datatype row_ = MPI_DATATYPE_NULL;
};

}  // namespace ibmfair::petsc
