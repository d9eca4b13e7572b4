// Vectors of lanes can be loaded from, and stored to, every address at which a single number can
// stand.
#include "ibmfair/base/lanes.h"

#include <array>
#include <numeric>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

// One more than four numbers: the rows start at every alignment that a number can have.
constexpr int stride = 5;

struct CopyRows {
  IBMFAIR_INLINE static void run(const double* numbers, double* stored) {
    const std::int32_t at[lane_count] = {0, stride, 2 * stride, 3 * stride};
    const Lanes4 rows = gather(numbers, at);
    store_rows(rows.xyz, rows.w, stored, stride);
  }
};

TEST(Lanes, RowsComeFromAnyAddressAndGoToAny) {
  std::array<double, stride * lane_count + 2> numbers;  // two numbers are read behind the last row
  std::iota(numbers.begin(), numbers.end(), 1.0);
  std::array<double, stride * lane_count> stored{};
  run_kernel<CopyRows>(numbers.data(), stored.data());
  for (int i = 0; i < lane_count; ++i) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(stored[stride * i + k], numbers[stride * i + k]) << i << ", " << k;
    }
  }
}

struct DoubleThreeNumbers {
  IBMFAIR_INLINE static void run(const double* numbers, double* row) {
    store(row, three_numbers(numbers) + three_numbers(numbers));
  }
};

TEST(Lanes, ThreeNumbersComeFromAnyAddress) {
  const std::array<double, 7> numbers{1, 2, 3, 4, 5, 6, 7};
  for (const int first : {0, 1, 2, 3}) {
    std::array<double, 5> row{};
    run_kernel<DoubleThreeNumbers>(numbers.data() + first, row.data() + first % 2);
    for (const int k : {0, 1, 2}) {
      EXPECT_EQ(row[first % 2 + k], 2 * numbers[first + k]);
    }
    EXPECT_EQ(row[first % 2 + 3], 0);
  }
}

struct AddRow {
  IBMFAIR_INLINE static void run(const double* numbers, double* row) {
    add_to_row(load<Lanes>(numbers), row);
  }
};

TEST(Lanes, RowsAreAddedAtAnyAddress) {
  const std::array<double, 5> numbers{1, 2, 3, 4, 5};
  for (const int first : {0, 1}) {
    std::array<double, 5> row{10, 20, 30, 40, 50};
    run_kernel<AddRow>(numbers.data() + first, row.data() + first);
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(row[first + k], numbers[first + k] + 10 * (first + k + 1));
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
