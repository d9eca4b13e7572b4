#include "petsc_engine/petsc_parts.h"

#include "petsc_engine/check.h"

namespace ibmfair::petsc {

PetscParts::PetscParts(const Communicator& comm, const MeshPiece& piece)
    : MeshParts(piece.own, static_cast<Index>(piece.vertex.size()), piece.own_triangle),
      comm_(comm) {
  const auto leaves = static_cast<PetscInt>(piece.home.size());
  std::vector<PetscInt> places(piece.home.size());
  std::vector<PetscSFNode> roots(piece.home.size());
  for (PetscInt i = 0; i < leaves; ++i) {
    places[i] = piece.own + i;
    roots[i] = {piece.home[i].rank, piece.home[i].place};
  }
  check(PetscSFCreate(comm.get(), &forest_));
  check(PetscSFSetFromOptions(forest_));
  check(PetscSFSetGraph(forest_, piece.own, leaves, places.data(), PETSC_COPY_VALUES, roots.data(),
                        PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest_));
  MPI_Type_contiguous(3, MPI_DOUBLE, &row_);
  MPI_Type_commit(&row_);
}

PetscParts::~PetscParts() {
  MPI_Type_free(&row_);
  PetscSFDestroy(&forest_);
}

void PetscParts::broadcast(MPI_Datatype unit, void* data) const {
  check(PetscSFBcastBegin(forest_, unit, data, data, MPI_REPLACE));
  check(PetscSFBcastEnd(forest_, unit, data, data, MPI_REPLACE));
}

void PetscParts::refresh(Points& rows) const {
  broadcast(row_, rows.data());
}

void PetscParts::refresh(std::vector<PetscInt>& values) const {
  broadcast(MPIU_INT, values.data());
}

}  // namespace ibmfair::petsc
