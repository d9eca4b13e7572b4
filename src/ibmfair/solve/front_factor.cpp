#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/flush_subnormals.h"
#include "ibmfair/solve/front_kernels.h"

extern "C" {  // BLAS and LAPACK, column by column
void spotrf_(const char* uplo, const int* n, float* A, const int* lda, int* info);
void dpotrf_(const char* uplo, const int* n, double* A, const int* lda, int* info);
void strsm_(const char* side, const char* uplo, const char* transposed, const char* diagonal,
            const int* m, const int* n, const float* alpha, const float* A, const int* lda,
            float* B, const int* ldb);
void dtrsm_(const char* side, const char* uplo, const char* transposed, const char* diagonal,
            const int* m, const int* n, const double* alpha, const double* A, const int* lda,
            double* B, const int* ldb);
void ssyrk_(const char* uplo, const char* transposed, const int* n, const int* k,
            const float* alpha, const float* A, const int* lda, const float* beta, float* C,
            const int* ldc);
void dsyrk_(const char* uplo, const char* transposed, const int* n, const int* k,
            const double* alpha, const double* A, const int* lda, const double* beta, double* C,
            const int* ldc);
void sgemm_(const char* transposed_a, const char* transposed_b, const int* m, const int* n,
            const int* k, const float* alpha, const float* A, const int* lda, const float* B,
            const int* ldb, const float* beta, float* C, const int* ldc);
void dgemm_(const char* transposed_a, const char* transposed_b, const int* m, const int* n,
            const int* k, const double* alpha, const double* A, const int* lda, const double* B,
            const int* ldb, const double* beta, double* C, const int* ldc);
}

namespace ibmfair {
namespace {

template <class Real>
struct Blas;

template <>
struct Blas<float> {
  static constexpr auto potrf = spotrf_;
  static constexpr auto trsm = strsm_;
  static constexpr auto syrk = ssyrk_;
  static constexpr auto gemm = sgemm_;
};

template <>
struct Blas<double> {
  static constexpr auto potrf = dpotrf_;
  static constexpr auto trsm = dtrsm_;
  static constexpr auto syrk = dsyrk_;
  static constexpr auto gemm = dgemm_;
};

// Columns that are factored together, and the piece that a thread takes.
constexpr int panel = 128, piece = 256;

/// Calls work(first, count) for pieces that cover 0 .. size - 1.
template <class Work>
void in_pieces(int size, Work&& work) {
  const int pieces = (size + piece - 1) / piece;
  const auto run = [&](std::int64_t p) {
    const FlushSubnormals flush;  // this may be another thread
    const int first = static_cast<int>(p) * piece;
    work(first, std::min(piece, size - first));
  };
  run_tasks(pieces, pieces > 1, run);
}

/// The lower triangle of C (side n) loses A A^T, A being n x k; `below` more rows follow.
template <class Real>
void subtract_square(int n, int below, int k, const Real* A, int lda, Real* C, int ldc) {
  const Real minus = -1, one = 1;
  in_pieces(n, [&](int first, int side) {
    const int rest = n + below - first - side;
    const Real* a = A + first;
    Real* c = C + first + std::int64_t{first} * ldc;
    Blas<Real>::syrk("L", "N", &side, &k, &minus, a, &lda, &one, c, &ldc);
    if (rest > 0) {
      Blas<Real>::gemm("N", "T", &rest, &side, &k, &minus, a + side, &lda, a, &lda, &one, c + side,
                       &ldc);
    }
  });
}

/// B (m x n) becomes B L^-T.
template <class Real>
void divide_by_triangle(int m, int n, const Real* L, Real* B, int ld) {
  const Real one = 1;
  in_pieces(m, [&](int first, int count) {
    Blas<Real>::trsm("R", "L", "T", "N", &count, &n, &one, L, &ld, B + first, &ld);
  });
}

}  // namespace

template <class Real>
Index factor_front(Index rows, Index columns, Real* block, Real* update) {
  for (int first = 0; first < columns; first += panel) {
    const int width = std::min(panel, columns - first), last = first + width;
    Real* diagonal = block + first + std::int64_t{first} * rows;
    int info = 0;
    Blas<Real>::potrf("L", &width, diagonal, &rows, &info);
    if (info > 0) {
      return first + info - 1;
    }
    if (rows > last) {
      divide_by_triangle(rows - last, width, diagonal, diagonal + width, rows);
    }
    if (columns > last) {
      subtract_square(columns - last, rows - columns, width, diagonal + width, rows,
                      block + last + std::int64_t{last} * rows, rows);
    }
  }
  if (const int below = rows - columns; below > 0) {
    subtract_square(below, 0, columns, block + columns, rows, update, below);
  }
  return -1;
}

template Index factor_front(Index, Index, float*, float*);
template Index factor_front(Index, Index, double*, double*);

}  // namespace ibmfair
