#include "ibmfair/solve/spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Spectra/SymGEigsShiftSolver.h>
#include <Spectra/SymGEigsSolver.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {
namespace {

constexpr Index small_enough_for_dense = 60;
constexpr Index krylov_vectors = 40;
constexpr Index most_restarts = 1000;
constexpr double tolerance = 1e-7;  // for residuals; eigenvalues have twice as many digits
constexpr double noise = 1e-8;  // of the largest one; an eigenvalue below -noise: L is indefinite

using Vector = Eigen::VectorXd;
using ConstMap = Eigen::Map<const Vector>;
using Map = Eigen::Map<Vector>;

Vector product(const SymmetricMatrix& A, const double* x) {
  Vector y = Vector::Zero(A.size());
  for (std::int64_t j = 0; j < A.size(); ++j) {
    const std::int64_t diagonal = A.column_first[j];
    double sum = A.value[diagonal] * x[j];
    for (std::int64_t k = diagonal + 1; k < A.column_first[j + 1]; ++k) {
      y[A.row[k]] += A.value[k] * x[j];
      sum += A.value[k] * x[A.row[k]];
    }
    y[j] += sum;
  }
  return y;
}

SymmetricMatrix sum(const SymmetricMatrix& A, double factor, const SymmetricMatrix& B) {
  SymmetricMatrix result = A;  // its pattern contains that of B: M has entries only where L has
  for (std::int64_t j = 0; j < B.size(); ++j) {
    std::int64_t place = A.column_first[j];
    for (std::int64_t k = B.column_first[j]; k < B.column_first[j + 1]; ++k) {
      while (A.row[place] != B.row[k]) {
        ++place;
      }
      result.value[place] += factor * B.value[k];
    }
  }
  return result;
}

/// Solves with one factorization, for one right-hand side at a time.
class Inverse {
 public:
  explicit Inverse(const SymmetricMatrix& A) : cholesky_(MultifrontalAnalysis(A)) {
    cholesky_.factor(A);
    B_ = Points::Zero(A.size(), 3);
  }

  Vector operator()(const double* x) const {
    B_.col(0) = ConstMap(x, B_.rows());
    B_.rightCols<2>().setZero();
    cholesky_.solve(B_, B_);
    return B_.col(0);
  }

 private:
  mutable MultifrontalCholesky cholesky_;
  mutable Points B_;
};

/// Products with a matrix, as Spectra takes them.
class Product {
 public:
  using Scalar = double;
  explicit Product(const SymmetricMatrix& A) : A_(A) {}
  Eigen::Index rows() const { return A_.size(); }
  Eigen::Index cols() const { return A_.size(); }
  void perform_op(const double* x, double* y) const { Map(y, rows()) = product(A_, x); }

 private:
  const SymmetricMatrix& A_;
};

/// Products with M and its inverse.
class Mass : public Product {
 public:
  explicit Mass(const SymmetricMatrix& M) : Product(M) {
    if (static_cast<std::int64_t>(M.row.size()) == M.size()) {
      diagonal_ = ConstMap(M.value.data(), M.size());
    } else {
      inverse_.emplace(M);
    }
  }

  void solve(const double* x, double* y) const {
    if (inverse_) {
      Map(y, rows()) = (*inverse_)(x);
    } else {
      Map(y, rows()) = ConstMap(x, rows()).cwiseQuotient(diagonal_);
    }
  }

 private:
  Vector diagonal_;
  std::optional<Inverse> inverse_;
};

/// Applies (L + shift M)^-1, then projects onto the M-orthogonal complement of the kernel of L. The
/// zero eigenvalues then do not hide the smallest other eigenvalue, however large it is.
class InverseOffKernel {
 public:
  using Scalar = double;
  InverseOffKernel(const SymmetricMatrix& shifted, const SymmetricMatrix& M,
                   const std::vector<Index>& part, Index parts)
      : inverse_(shifted), part_(part), mass_(product(M, Vector::Ones(M.size()).eval().data())) {
    area_ = sums(mass_, parts);
  }

  Eigen::Index rows() const { return mass_.size(); }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double) {}  // the shift is fixed by the constructor

  void perform_op(const double* x, double* y) const {
    Vector u = inverse_(x);
    const Vector mean = sums(u.cwiseProduct(mass_), area_.size()).cwiseQuotient(area_);
    for (Eigen::Index i = 0; i < rows(); ++i) {
      u[i] -= mean[part_[i]];
    }
    Map(y, rows()) = u;
  }

 private:
  Vector sums(const Vector& values, Eigen::Index parts) const {
    Vector result = Vector::Zero(parts);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      result[part_[i]] += values[i];
    }
    return result;
  }

  Inverse inverse_;
  const std::vector<Index>& part_;
  Vector mass_, area_;
};

double total(const SymmetricMatrix& M) {
  return product(M, Vector::Ones(M.size()).eval().data()).sum();
}

Eigen::MatrixXd dense(const SymmetricMatrix& A) {
  Eigen::MatrixXd result(A.size(), A.size());
  for (std::int64_t j = 0; j < A.size(); ++j) {
    const Vector unit = Vector::Unit(A.size(), j);
    result.col(j) = product(A, unit.data());
  }
  return result;
}

void find_in_dense(const LaplacianMatrices& matrices, SpectrumEnds& ends) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      dense(matrices.L), dense(matrices.M), Eigen::EigenvaluesOnly);
  const Vector& values = solver.eigenvalues();
  ends.largest = values[values.size() - 1];
  if (values[0] >= -noise * *ends.largest) {
    ends.smallest = values[ends.zeros];
  }
}

/// The eigenvalue of (L, M) that belongs to the largest eigenvalue of the solver's operator.
template <class Solver>
std::optional<double> outermost(Solver& solver) {
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful) {
    return {};
  }
  return solver.eigenvalues()[0];
}

std::optional<double> largest(const LaplacianMatrices& matrices) {
  Product L(matrices.L);
  Mass M(matrices.M);
  Spectra::SymGEigsSolver<Product, Mass, Spectra::GEigsMode::RegularInverse> solver(L, M, 1,
                                                                                    krylov_vectors);
  return outermost(solver);
}

std::optional<double> smallest(const LaplacianMatrices& matrices, const std::vector<Index>& part,
                               Index parts) {
  // About the size of the wanted eigenvalue, for a component of average area.
  const double shift = parts / total(matrices.M);
  Product M(matrices.M);
  try {
    InverseOffKernel inverse(sum(matrices.L, shift, matrices.M), matrices.M, part, parts);
    Spectra::SymGEigsShiftSolver<InverseOffKernel, Product, Spectra::GEigsMode::ShiftInvert> solver(
        inverse, M, 1, krylov_vectors, -shift);
    return outermost(solver);
  } catch (const FactorizationFailed&) {  // L is not positive semi-definite
    return {};
  }
}

}  // namespace

SpectrumEnds spectrum_ends(const LaplacianMatrices& matrices) {
  const std::vector<Index> part = joined_parts(matrices);
  SpectrumEnds ends;
  ends.nodes = static_cast<Index>(part.size());
  ends.zeros = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
  const double area = total(matrices.M);
  const bool in_range = std::isfinite(total(matrices.L)) && std::isfinite(area) && area > 0;
  if (ends.zeros == ends.nodes || !in_range) {
    return ends;
  }
  if (ends.nodes <= small_enough_for_dense) {
    find_in_dense(matrices, ends);
  } else {
    ends.largest = largest(matrices);
    ends.smallest = smallest(matrices, part, ends.zeros);
  }
  if (ends.smallest && !(*ends.smallest > 0)) {
    ends.smallest.reset();
  }
  return ends;
}

}  // namespace ibmfair
