#include "petsc_engine/petsc_jacobian.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/linear_system/iterative_jacobian.h"
#include "petsc_engine/check.h"

namespace ibmfair::petsc {
namespace {

/// Forecast number of iterations, with the diagonal as preconditioner, from which on BoomerAMG is
/// faster in spite of its set-up and its longer iterations (tools/ranks_table).
constexpr double many_iterations = 120;

/// Calls `copy` with the entries of the vector that this rank stores.
template <class Copy>
void with_entries(Vec vector, const Copy& copy) {
  PetscScalar* entries = nullptr;
  check(VecGetArray(vector, &entries));
  copy(entries);
  check(VecRestoreArray(vector, &entries));
}

}  // namespace

PetscJacobian::PetscJacobian(const JacobianShape& shape, const PetscParts& parts,
                             LinearSolver solver)
    : shape_(shape), comm_(parts.communicator()), solver_(solver) {
  const Stopwatch watch(shape.report.seconds.analyse);
  number_unknowns(parts);
  make_matrix();
}

PetscJacobian::~PetscJacobian() {
  KSPDestroy(&ksp_);
  VecDestroy(&x_);
  VecDestroy(&b_);
  MatDestroy(&J_);
}

void PetscJacobian::number_unknowns(const PetscParts& parts) {
  const PetscInt own = shape_.unknowns.size();
  MPI_Exscan(&own, &first_, 1, MPIU_INT, MPI_SUM, comm_.get());
  number_.assign(shape_.unknowns.unknown.size(), -1);
  slot_.assign(number_.size(), -1);
  for (PetscInt u = 0; u < own; ++u) {
    number_[shape_.unknowns.vertex[u]] = first_ + u;
  }
  parts.refresh(number_);
}

void PetscJacobian::gather(Index u, const JacobianParts* parts, Row& row) {
  row.column.clear();
  row.value.clear();
  const Index vertex = shape_.unknowns.vertex[u];
  const auto slot_of = [&](Index v) {
    if (slot_[v] < 0) {
      slot_[v] = static_cast<PetscInt>(row.column.size());
      row.column.push_back(number_[v]);
      row.value.push_back(0);
    }
    return slot_[v];
  };
  slot_of(vertex);
  shape_.terms.for_vertices(vertex, [&](Index v) {
    if (number_[v] >= 0) {
      slot_of(v);
    }
  });
  if (parts != nullptr) {
    shape_.terms.for_terms(vertex, parts->weights, [&](Index v, double term) {
      if (number_[v] >= 0) {
        row.value[slot_[v]] += parts->h * term;
      }
    });
    row.value[slot_[vertex]] += parts->D[u];
  }
  slot_[vertex] = -1;
  shape_.terms.for_vertices(vertex, [&](Index v) { slot_[v] = -1; });
}

void PetscJacobian::make_matrix() {
  const PetscInt own = shape_.unknowns.size();
  std::vector<PetscInt> here(static_cast<std::size_t>(own)), elsewhere(here);
  Row row;
  for (PetscInt u = 0; u < own; ++u) {
    gather(u, nullptr, row);
    here[u] = static_cast<PetscInt>(
        std::count_if(row.column.begin(), row.column.end(),
                      [&](PetscInt column) { return column >= first_ && column < first_ + own; }));
    elsewhere[u] = static_cast<PetscInt>(row.column.size()) - here[u];
  }
  check(MatCreateAIJ(comm_.get(), own, own, PETSC_DETERMINE, PETSC_DETERMINE, 0, here.data(), 0,
                     elsewhere.data(), &J_));
  check(MatSetOption(J_, MAT_SPD, PETSC_TRUE));
  check(MatSetOption(J_, MAT_SPD_ETERNAL, PETSC_TRUE));
  check(MatSetOption(J_, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  check(MatCreateVecs(J_, &x_, &b_));
}

void PetscJacobian::make_solver(const JacobianParts& parts) {
  check(KSPCreate(comm_.get(), &ksp_));
  check(KSPSetType(ksp_, KSPCG));
  check(KSPSetNormType(ksp_, KSP_NORM_NATURAL));
  check(KSPSetTolerances(ksp_, shape_.options.solver_tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                         most_iterations(shape_.options.solver_tolerance)));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  if (solver_ == LinearSolver::mumps) {
    check(KSPSetType(ksp_, KSPPREONLY));
    check(KSPSetNormType(ksp_, KSP_NORM_NONE));
    check(PCSetType(pc, PCCHOLESKY));
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  } else if (comm_.max(forecast_iterations(shape_, parts).of_cutoff) < many_iterations) {
    check(PCSetType(pc, PCSOR));
  } else {
    check(PCSetType(pc, PCHYPRE));
    check(PCHYPRESetType(pc, "boomeramg"));
  }
  check(KSPSetFromOptions(ksp_));
  KSPType method = nullptr;
  PCType preconditioner = nullptr;
  check(KSPGetType(ksp_, &method));
  check(PCGetType(pc, &preconditioner));
  shape_.report.solver = fmt::format("petsc {} {}", method, preconditioner);
  const std::string_view kind = preconditioner;
  factors_ = kind == PCCHOLESKY || kind == PCLU;
}

void PetscJacobian::update(const JacobianParts& parts) {
  {
    const Stopwatch watch(shape_.report.seconds.assemble);
    Row row;
    for (Index u = 0; u < shape_.unknowns.size(); ++u) {
      gather(u, &parts, row);
      const PetscInt number = first_ + u;
      check(MatSetValues(J_, 1, &number, static_cast<PetscInt>(row.column.size()),
                         row.column.data(), row.value.data(), INSERT_VALUES));
    }
    check(MatAssemblyBegin(J_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(J_, MAT_FINAL_ASSEMBLY));
  }
  const Stopwatch watch(shape_.report.seconds.factor);
  if (ksp_ == nullptr) {
    make_solver(parts);
  }
  SetUp result = set_up();
  // MUMPS estimates its work space and adds a margin of 20 %. The space that it needs depends on
  // the arrival times of messages from other ranks, so that the margin can be too small.
  for (const char* to_spare : {"100", "400", "1600"}) {
    if (result != SetUp::short_of_space || !factors_) {
      break;
    }
    check(PetscOptionsSetValue(nullptr, "-mat_mumps_icntl_14", to_spare));
    result = set_up();
  }
  if (result != SetUp::done) {
    throw FactorizationFailed(
        result == SetUp::short_of_space
            ? "the system cannot be factored: there is not enough memory"
            : "the preconditioner cannot be set up: the mesh may have triangles with angles near "
              "zero");
  }
  shape_.report.factorizations += factors_ ? 1 : 0;
}

PetscJacobian::SetUp PetscJacobian::set_up() {
  PC pc = nullptr;
  PCFailedReason reason = PC_NOERROR;
  check(KSPSetOperators(ksp_, J_, J_));
  check(KSPSetUp(ksp_));
  check(KSPGetPC(ksp_, &pc));
  check(PCGetFailedReason(pc, &reason));
  if (!comm_.any(reason != PC_NOERROR)) {
    return SetUp::done;
  }
  check(PCReset(pc));  // without it, a failed factorization fails for every later matrix
  return comm_.any(reason == PC_FACTOR_OUTMEMORY) ? SetUp::short_of_space : SetUp::failed;
}

void PetscJacobian::solve(const Points& B, Points& Y) {
  const Stopwatch watch(shape_.report.seconds.solve);
  const Eigen::Index own = shape_.unknowns.size();
  Y.resize(own, 3);
  for (int c = 0; c < 3; ++c) {
    with_entries(b_, [&](PetscScalar* b) {
      for (Eigen::Index u = 0; u < own; ++u) {
        b[u] = B(u, c);
      }
    });
    check(KSPSolve(ksp_, b_, x_));
    with_entries(x_, [&](const PetscScalar* x) {
      for (Eigen::Index u = 0; u < own; ++u) {
        Y(u, c) = x[u];
      }
    });
    PetscInt iterations = 0;
    check(KSPGetIterationNumber(ksp_, &iterations));
    shape_.report.iterations += static_cast<int>(iterations);
  }
}

void PetscJacobian::tighten(double tolerance) {
  PetscReal now = 0;
  check(KSPGetTolerances(ksp_, &now, nullptr, nullptr, nullptr));
  check(KSPSetTolerances(ksp_, std::min(now, tolerance), PETSC_DEFAULT, PETSC_DEFAULT,
                         PETSC_DEFAULT));
}

}  // namespace ibmfair::petsc
