// Substitution with one front is that with its triangle and the rows below, for every width of the
// last panel and chunk, for last packs of every size, and for fronts beside which the vectors leave
// the first cache.
#include "ibmfair/solve/front_kernels.h"

#include <limits>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

template <class Real>
struct Front {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vectors = Eigen::Matrix<Real, Eigen::Dynamic, 4, Eigen::RowMajor>;
  static constexpr Real nobody_may_use = std::numeric_limits<Real>::quiet_NaN();

  Front(Index rows, Index columns)
      : L(Matrix::Random(rows, columns)),
        W(Vectors::Random(rows, 4)),
        workspace(static_cast<std::size_t>(workspace_size<Real>(rows)), nobody_may_use) {
    L.diagonal().array() += 4;
    L *= Real(0.25);
    for (Index j = 1; j < columns; ++j) {
      L.col(j).head(j).setConstant(nobody_may_use);
    }
    packed.assign(static_cast<std::size_t>(packed_size<Real>(rows, columns)), nobody_may_use);
    pack_front(L.data(), rows, columns, packed.data());
  }

  /// [L11^-1 W1; W2 - L21 L11^-1 W1].
  Vectors forward() {
    const auto rows = static_cast<Index>(L.rows()), columns = static_cast<Index>(L.cols());
    Vectors own(columns, 4), below(rows - columns, 4), result(rows, 4);
    substitute_forward(packed.data(), rows, columns, W.data(), own.data(), below.data(),
                       workspace.data());
    result << own, below;
    return result;
  }

  /// [L11^-T (W1 - L21^T W2); W2], out of a list of vectors that has others between those below.
  Vectors backward() {
    const auto rows = static_cast<Index>(L.rows()), columns = static_cast<Index>(L.cols());
    constexpr Index before = 5;
    std::vector<Index> row;
    for (Index i = 0; i < rows; ++i) {
      row.push_back(before + (i < columns ? i : 3 * i));
    }
    Vectors x = Vectors::Constant(row.back() + 1, 4, nobody_may_use);
    x(row, Eigen::all) = W;
    substitute_backward(packed.data(), rows, columns, row.data(), x.data(), workspace.data());
    return x(row, Eigen::all);
  }

  Matrix L;
  Vectors W;
  std::vector<Real> packed, workspace;
};

template <class Real>
class FrontKernels : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(FrontKernels, Reals);

TYPED_TEST(FrontKernels, SubstituteAsTheDenseTriangleDoes) {
  const auto coordinates = [](const auto& vectors) {
    return vectors.template leftCols<3>().eval();
  };
  for (const Index columns : {1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 16, 23}) {
    for (const Index below : {0, 1, 2, 3, 4, 5, 6, 7, 10, 400, 1101}) {
      SCOPED_TRACE(testing::Message() << columns << " columns, " << below << " rows below");
      Front<TypeParam> front(columns + below, columns);
      const auto L11 = front.L.topRows(columns), L21 = front.L.bottomRows(below);
      const auto own = front.W.topRows(columns);
      const auto others = front.W.bottomRows(below);
      const auto tolerance = 100 * std::numeric_limits<TypeParam>::epsilon();

      auto expected = front.W;
      expected.topRows(columns) = L11.template triangularView<Eigen::Lower>().solve(own);
      expected.bottomRows(below) = others - L21 * expected.topRows(columns);
      EXPECT_LT(coordinates(front.forward() - expected).norm(), tolerance * expected.norm());

      expected = front.W;
      expected.topRows(columns) = L11.transpose().template triangularView<Eigen::Upper>().solve(
          own - L21.transpose() * others);
      EXPECT_LT(coordinates(front.backward() - expected).norm(), tolerance * expected.norm());
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
