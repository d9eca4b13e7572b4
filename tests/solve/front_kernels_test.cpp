// The operations on a front agree with the same operations on the dense matrix in the front. The
// tests cover every width of the last panel, chunk and strip, last packs of every size, and fronts
// beside which the vectors leave the first cache. Entries outside the front are NaN and must not be
// used.
#include "ibmfair/solve/front_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "ibmfair/base/threads.h"

namespace ibmfair::test {
namespace {

template <class Real>
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

template <class Real>
constexpr Real nobody_may_use = std::numeric_limits<Real>::quiet_NaN();

/// The block of a front, with the first columns of the lower triangle of A.
template <class Real>
std::vector<Real> block_of(const FrontLayout<Real>& front, const Matrix<Real>& A) {
  std::vector<Real> block(static_cast<std::size_t>(front.block_size()), nobody_may_use<Real>);
  for (Index j = 0; j < front.columns; ++j) {
    for (Index i = j; i < front.pack * front.packs(); ++i) {
      block[front.in_block(i) + front.pack * j] = i < front.rows ? A(i, j) : 0;
    }
  }
  return block;
}

template <class Real>
struct FactoredFront {
  using Vectors = Eigen::Matrix<Real, Eigen::Dynamic, 4, Eigen::RowMajor>;

  FactoredFront(Index rows, Index columns)
      : L(Matrix<Real>::Random(rows, columns)),
        W(Vectors::Random(rows, 4)),
        workspace(static_cast<std::size_t>(workspace_size<Real>(rows)), nobody_may_use<Real>) {
    L.diagonal().array() += 4;
    L *= Real(0.25);
    packed.assign(static_cast<std::size_t>(packed_size<Real>(rows, columns)), nobody_may_use<Real>);
    const FrontLayout<Real> layout{rows, columns};
    pack_front(layout, block_of(layout, L).data(), packed.data());
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

  /// [L11^-T (W1 - L21^T W2); W2], where W is taken from a longer list of vectors that has other
  /// vectors between the rows of W2.
  Vectors backward() {
    const auto rows = static_cast<Index>(L.rows()), columns = static_cast<Index>(L.cols());
    constexpr Index before = 5;
    std::vector<Index> row;
    row.reserve(static_cast<std::size_t>(rows));
    for (Index i = 0; i < rows; ++i) {
      row.push_back(before + (i < columns ? i : 3 * i));
    }
    Vectors x = Vectors::Constant(row.back() + 1, 4, nobody_may_use<Real>);
    x(row, Eigen::all) = W;
    substitute_backward(packed.data(), rows, columns, row.data(), x.data(), workspace.data());
    return x(row, Eigen::all);
  }

  Matrix<Real> L;
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
      FactoredFront<TypeParam> front(columns + below, columns);
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

/// A random symmetric positive definite matrix with a unit diagonal.
template <class Real>
Matrix<Real> random_positive(Index size) {
  const Matrix<Real> R = Matrix<Real>::Random(size, size);
  const Matrix<Real> A = R * R.transpose() + Real(size) / 4 * Matrix<Real>::Identity(size, size);
  const auto scale = A.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  return scale * A * scale;
}

template <class Real>
struct Factors {
  Index bad;
  std::vector<Real> block, update;
};

template <class Real>
Factors<Real> factors_of(const FrontLayout<Real>& front, const Matrix<Real>& A) {
  Factors<Real> result{0, block_of(front, A), {}};
  result.update.assign(static_cast<std::size_t>(front.update_size()), nobody_may_use<Real>);
  result.bad = factor_front(front, result.block.data(), result.update.data());
  return result;
}

const std::vector<Index> widths{1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 16, 23, 128, 131, 260, 301};

TYPED_TEST(FrontKernels, FactorAsTheDenseMatrixIs) {
  using Real = TypeParam;
  for (const Index columns : widths) {
    for (const Index below : {0, 1, 2, 3, 4, 5, 6, 7, 10, 61}) {
      SCOPED_TRACE(testing::Message() << columns << " columns, " << below << " rows below");
      const FrontLayout<Real> front{columns + below, columns};
      const Matrix<Real> A = random_positive<Real>(front.rows);
      const auto [bad, block, update] = factors_of(front, A);
      ASSERT_EQ(bad, -1);

      Matrix<Real> L = A.leftCols(columns), rest = A.bottomRightCorner(below, below);
      const Matrix<Real> L11 = L.topRows(columns).llt().matrixL();
      L.topRows(columns) = L11;
      L.bottomRows(below) = L11.template triangularView<Eigen::Lower>()
                                .solve(A.bottomLeftCorner(below, columns).transpose())
                                .transpose();
      rest = -L.bottomRows(below) * L.bottomRows(below).transpose();
      double error = 0;
      for (Index j = 0; j < front.rows; ++j) {
        for (Index i = j; i < front.rows; ++i) {
          const double got = j < columns ? block[front.in_block(i) + front.pack * j]
                                         : update[front.in_update(i) + front.pack * j];
          const double expected = j < columns ? L(i, j) : rest(i - columns, j - columns);
          error += std::abs(got - expected);  // NaN if one of them is NaN
        }
      }
      EXPECT_LT(error, 20 * std::numeric_limits<Real>::epsilon() * front.rows * front.rows);
    }
  }
}

TYPED_TEST(FrontKernels, NameTheFirstPivotThatIsNotPositive) {
  for (const Index columns : widths) {
    for (const Index bad : {Index{0}, columns / 2, columns - 1}) {
      for (const double pivot : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        Matrix<TypeParam> A = random_positive<TypeParam>(columns + 5);
        A(bad, bad) = static_cast<TypeParam>(pivot);
        EXPECT_EQ(factors_of(FrontLayout<TypeParam>{columns + 5, columns}, A).bad, bad);
      }
    }
  }
}

TYPED_TEST(FrontKernels, FactorIntoTheSameBytesOnAnyNumberOfThreads) {
  const FrontLayout<TypeParam> front{900, 500};
  const Matrix<TypeParam> A = random_positive<TypeParam>(front.rows);
  const auto bytes = [&](int threads) {
    set_thread_count(threads);
    auto [bad, block, update] = factors_of(front, A);
    block.insert(block.end(), update.begin(), update.end());
    return std::string(reinterpret_cast<const char*>(block.data()),
                       block.size() * sizeof(TypeParam));
  };
  const std::string on_one = bytes(1);
  EXPECT_EQ(bytes(2), on_one);
  EXPECT_EQ(bytes(5), on_one);
  set_thread_count(0);
}

TYPED_TEST(FrontKernels, AddEachEntryOfAnUpdateInItsPlace) {
  using Real = TypeParam;
  std::mt19937 random(7);
  for (const Index own : {1, 4, 7, 8, 13}) {
    for (const Index columns : {1, 3, 8, 20}) {
      for (const Index step : {1, 2}) {  // consecutive rows, and other rows
        SCOPED_TRACE(testing::Message() << own << ", " << columns << ", " << step);
        const FrontLayout<Real> child{own + 30, own}, parent{90, columns};
        std::vector<Index> place(own, -1);
        for (Index i = own, at = static_cast<Index>(random() % 9); i < child.rows; ++i) {
          place.push_back(at);
          at += step == 1 && random() % 8 != 0 ? 1 : 1 + static_cast<Index>(random() % 2);
        }
        std::vector<Real> update(static_cast<std::size_t>(child.update_size()),
                                 nobody_may_use<Real>);
        Matrix<Real> expected = Matrix<Real>::Zero(parent.rows, parent.rows);
        for (Index j = own; j < child.rows; ++j) {
          for (Index i = j; i < child.pack * child.packs(); ++i) {
            const Real number = i < child.rows ? static_cast<Real>(random() % 1000) : 0;
            update[child.in_update(i) + child.pack * j] = number;
            if (i < child.rows) expected(place[i], place[j]) = number;
          }
        }
        std::vector<Real> block(static_cast<std::size_t>(parent.block_size())),
            rest(static_cast<std::size_t>(parent.update_size()));
        add_update(child, update.data(), parent, place.data(), FrontPart::block, block.data());
        add_update(child, update.data(), parent, place.data(), FrontPart::update, rest.data());
        for (Index j = 0; j < parent.rows; ++j) {
          for (Index i = j; i < parent.rows; ++i) {
            ASSERT_EQ(j < columns ? block[parent.in_block(i) + parent.pack * j]
                                  : rest[parent.in_update(i) + parent.pack * j],
                      expected(i, j))
                << i << ", " << j;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
