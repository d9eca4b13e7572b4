// Lists of rows are the same for any number of threads.
#include "ibmfair/base/compressed_rows.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/parallel.h"

namespace ibmfair::test {
namespace {

/// Values to be sorted into rows. There are enough values for several threads; one value in ten is
/// -1 and belongs to no row.
std::vector<Index> some_values(Index rows) {
  std::mt19937 random(7);
  std::uniform_int_distribution<Index> any(0, rows - 1), tenth(0, 9);
  std::vector<Index> values(static_cast<std::size_t>(3 * worth_sharing));
  std::generate(values.begin(), values.end(),
                [&] { return tenth(random) == 0 ? -1 : any(random); });
  return values;
}

TEST(CompressedRows, ListThePositionsOfEachValueInOrderForAnyNumberOfThreads) {
  for (const Index count : {1, 2, 7, 1000, 100'000}) {
    const std::vector<Index> values = some_values(count);
    std::vector<std::vector<Index>> expected(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] >= 0) expected[values[i]].push_back(static_cast<Index>(i));
    }
    for (const int threads : {1, 2, 3, 16}) {
      set_thread_count(threads);
      const CompressedRows rows = positions_by_value(values, count);
      ASSERT_EQ(rows.size(), count);
      for (Index v = 0; v < count; ++v) {
        ASSERT_TRUE(std::ranges::equal(rows[v], expected[v])) << v << " of " << count;
      }
    }
    set_thread_count(0);
  }
}

TEST(CompressedRows, RangesMakeUpTheWhole) {
  for (const int threads : {1, 3, 16}) {
    set_thread_count(threads);
    for (const std::int64_t count : {0, 1, 5, 1000}) {
      for (const std::int64_t work : {std::int64_t{0}, worth_sharing}) {
        std::vector<int> times(static_cast<std::size_t>(count), 0);
        parallel_ranges(count, work, [&](std::int64_t first, std::int64_t last) {
          for (std::int64_t i = first; i < last; ++i) {
            ++times[i];
          }
        });
        EXPECT_EQ(std::ranges::count(times, 1), count);
      }
    }
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace ibmfair::test
