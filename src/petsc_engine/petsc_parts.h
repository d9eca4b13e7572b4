// The communication between the parts of a mesh that the flow needs, by PETSc and MPI.
#pragma once

#include <petscsf.h>

#include "ibmfair/flow/mesh_parts.h"
#include "petsc_engine/mesh_piece.h"

namespace ibmfair::petsc {

class PetscParts final : public MeshParts {
 public:
  /// `comm` and `piece` must outlive this object. All members, this one included, are collective.
  PetscParts(const Communicator& comm, const MeshPiece& piece);
  ~PetscParts() override;
  PetscParts(const PetscParts&) = delete;
  PetscParts& operator=(const PetscParts&) = delete;

  double sum(double x) const override { return comm_.sum(x); }
  double max(double x) const override { return comm_.max(x); }
  void refresh(Points& rows) const override;
  using MeshParts::refresh;
  /// Updates the values (#V) at vertices that belong to other parts with the values there.
  void refresh(std::vector<PetscInt>& values) const;

  const Communicator& communicator() const { return comm_; }

 private:
  void broadcast(MPI_Datatype unit, void* data) const;

  const Communicator& comm_;
  PetscSF forest_ = nullptr;  // roots: a rank's own vertices; leaves: its copies of others
  MPI_Datatype row_ = MPI_DATATYPE_NULL;
};

}  // namespace ibmfair::petsc
