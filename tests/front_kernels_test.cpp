// Substitution with one front is that with its triangle and the rows below, for every width of the
// last panel and for fronts beside which the vectors leave the first cache.
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

  Front(Index rows, Index columns) : L(Matrix::Random(rows, columns)), W(Vectors::Random(rows, 4)) {
    L.diagonal().array() += 4;
    L *= Real(0.25);
    for (Index j = 1; j < columns; ++j) {
      L.col(j).head(j).setConstant(std::numeric_limits<Real>::quiet_NaN());  // nobody may use it
    }
    packed.resize(static_cast<std::size_t>(packed_size(rows, columns)));
    pack_front(L.data(), rows, columns, packed.data());
  }

  Matrix L;
  Vectors W;
  std::vector<Real> packed;
};

template <class Real>
class FrontKernels : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(FrontKernels, Reals);

TYPED_TEST(FrontKernels, SubstituteAsTheDenseTriangleDoes) {
  for (const Index columns : {1, 2, 3, 4, 5, 6, 7, 8, 13}) {
    for (const Index below : {0, 1, 2, 3, 10, 400, 1001}) {
      Front<TypeParam> front(columns + below, columns);
      const auto L11 = front.L.topRows(columns), L21 = front.L.bottomRows(below);
      const auto own = front.W.topRows(columns);
      const auto others = front.W.bottomRows(below);
      const auto tolerance = 100 * std::numeric_limits<TypeParam>::epsilon();

      auto forward = front.W;
      substitute_forward(front.packed.data(), columns + below, columns, forward.data());
      auto expected = front.W;
      expected.topRows(columns) = L11.template triangularView<Eigen::Lower>().solve(own);
      expected.bottomRows(below) = others - L21 * expected.topRows(columns);
      EXPECT_LT((forward - expected).norm(), tolerance * expected.norm());

      auto backward = front.W;
      substitute_backward(front.packed.data(), columns + below, columns, backward.data());
      expected = front.W;
      expected.topRows(columns) = L11.transpose().template triangularView<Eigen::Upper>().solve(
          own - L21.transpose() * others);
      EXPECT_LT((backward - expected).norm(), tolerance * expected.norm());
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
