#include "ibmfair/solve/cholmod_cholesky.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/solve/cholmod_library.h"

namespace ibmfair {
namespace {

/// CHOLMOD's view of a matrix.
cholmod_sparse view_of(const SymmetricMatrix& J) {
  // CHOLMOD takes pointers to numbers that it only reads.
  auto& numbers = const_cast<SymmetricMatrix&>(J);
  cholmod_sparse A{};
  A.nrow = A.ncol = static_cast<std::size_t>(J.size());
  A.nzmax = J.row.size();
  A.p = numbers.column_first.data();
  A.i = numbers.row.data();
  A.x = numbers.value.data();
  A.stype = -1;  // the lower triangle
  A.itype = CHOLMOD_LONG;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

}  // namespace

/// What belongs to one factor. The dense matrices are CHOLMOD's workspaces of solves.
struct CholmodCholesky::State {
  State() : cholmod(cholmod_functions()) {
    cholmod.start(&common);
    common.print = 0;
    common.error_handler = nullptr;  // statuses become exceptions in check()
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    common.quick_return_if_not_posdef = 1;
    common.useGPU = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }

  ~State() {
    for (cholmod_dense** matrix : {&X, &Y, &E}) {
      cholmod.free_dense(matrix, &common);
    }
    cholmod.free_factor(&L, &common);
    cholmod.finish(&common);
  }

  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// The unknowns in elimination order.
  std::span<const std::int64_t> unknowns() const {
    return {static_cast<const std::int64_t*>(L->Perm), L->n};
  }

  /// Throws if the last call did not succeed.
  void check() const {
    switch (common.status) {
      case CHOLMOD_OK:
      case CHOLMOD_DSMALL:  // never with L L^T
        return;
      case CHOLMOD_NOT_POSDEF:
        refuse_indefinite(static_cast<Index>(unknowns()[L->minor]));
      case CHOLMOD_OUT_OF_MEMORY:
        throw OutOfMemory("out of memory in CHOLMOD");
      case CHOLMOD_TOO_LARGE:
        throw OutOfMemory("the matrix is larger than CHOLMOD's index type");
      default:
        throw FactorizationFailed(
            fmt::format("CHOLMOD failed (status {})", static_cast<int>(common.status)));
    }
  }

  const CholmodFunctions& cholmod;
  cholmod_common common{};
  cholmod_factor* L = nullptr;
  cholmod_dense *X = nullptr, *Y = nullptr, *E = nullptr;
  std::vector<double> right_hand_sides;  // n x 3, by columns
};

CholmodCholesky::CholmodCholesky(const SymmetricMatrix& J, const Points& X)
    : CholmodCholesky(J, elimination_order(graph_of(J), X)) {}

CholmodCholesky::CholmodCholesky(const SymmetricMatrix& J, const EliminationOrder& order)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  std::vector<std::int64_t> unknown(order.unknown.begin(), order.unknown.end());
  cholmod_sparse A = view_of(J);
  state.L = state.cholmod.analyze_p(&A, unknown.data(), nullptr, 0, &state.common);
  state.check();
  forecast_ = {order.method, state.common.fl, state.common.lnz};
  state.right_hand_sides.resize(3 * unknown.size());
}

CholmodCholesky::~CholmodCholesky() = default;
CholmodCholesky::CholmodCholesky(CholmodCholesky&&) noexcept = default;
CholmodCholesky& CholmodCholesky::operator=(CholmodCholesky&&) noexcept = default;

void CholmodCholesky::factor(const SymmetricMatrix& J) {
  State& state = *state_;
  for (const std::int64_t unknown : state.unknowns()) {
    const double diagonal = J.value[J.column_first[unknown]];
    if (!(diagonal > 0) || !std::isfinite(diagonal)) {
      refuse_indefinite(static_cast<Index>(unknown));
    }
  }
  cholmod_sparse A = view_of(J);
  state.cholmod.factorize(&A, state.L, &state.common);
  state.check();
}

void CholmodCholesky::solve(const Points& B, Points& Y) {
  State& state = *state_;
  const Eigen::Index n = B.rows();
  Eigen::Map<Eigen::MatrixX3d>(state.right_hand_sides.data(), n, 3) = B;
  cholmod_dense right{};
  right.nrow = right.d = static_cast<std::size_t>(n);
  right.ncol = 3;
  right.nzmax = state.right_hand_sides.size();
  right.x = state.right_hand_sides.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  state.cholmod.solve2(CHOLMOD_A, state.L, &right, nullptr, &state.X, nullptr, &state.Y, &state.E,
                       &state.common);
  state.check();
  Y = Eigen::Map<const Eigen::MatrixX3d>(static_cast<const double*>(state.X->x), n, 3);
}

}  // namespace ibmfair
