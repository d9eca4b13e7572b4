// Vectors come from memory, and go there, wherever single numbers may stand.
#include "ibmfair/base/lanes.h"

#include <array>
#include <numeric>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

// One more than four numbers: rows start at every alignment that a number can have.
constexpr int stride = 5;

template <class Lanes>
struct LanesTest : testing::Test {
  static constexpr int lanes = lane_count<Lanes>;

  std::array<double, stride * lanes + 2> numbers;  // kernels read two numbers behind rows
  std::array<double, stride * lanes> stored{};

  LanesTest() { std::iota(numbers.begin(), numbers.end(), 1.0); }
};
using VectorTypes = testing::Types<Four, Eight>;
TYPED_TEST_SUITE(LanesTest, VectorTypes);

/// Functions of lanes take pointers: this one is inlined nowhere and knows no alignment.
template <class Lanes>
[[gnu::noinline]] void gather_and_store(const double* numbers, double* stored) {
  std::array<std::int32_t, lane_count<Lanes>> at;
  for (int i = 0; i < lane_count<Lanes>; ++i) {
    at[i] = stride * i;
  }
  const Lanes4<Lanes> rows = gather<Lanes>(numbers, at.data());
  store_rows<Lanes>(rows.xyz, rows.w, stored, stride);
}

TYPED_TEST(LanesTest, RowsComeFromAnyAddressAndGoToAny) {
  gather_and_store<TypeParam>(this->numbers.data(), this->stored.data());
  for (int i = 0; i < this->lanes; ++i) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(this->stored[stride * i + k], this->numbers[stride * i + k]) << i << ", " << k;
    }
  }
}

[[gnu::noinline]] void double_three_numbers(const double* numbers, double* row) {
  store(row, three_numbers(numbers) + three_numbers(numbers));
}

TEST(Lanes, ThreeNumbersComeFromAnyAddress) {
  const std::array<double, 7> numbers{1, 2, 3, 4, 5, 6, 7};
  for (const int first : {0, 1, 2, 3}) {
    std::array<double, 5> row{};
    double_three_numbers(numbers.data() + first, row.data() + first % 2);
    for (const int k : {0, 1, 2}) {
      EXPECT_EQ(row[first % 2 + k], 2 * numbers[first + k]);
    }
    EXPECT_EQ(row[first % 2 + 3], 0);
  }
}

}  // namespace
}  // namespace ibmfair::test
