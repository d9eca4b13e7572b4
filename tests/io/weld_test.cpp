// Welding within a tolerance.
#include "ibmfair/io/weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace ibmfair::test {
namespace {

/// For each vertex the smallest one that a chain of steps of at most `tolerance` joins to it.
std::vector<Index> joined_directly(const Points& X, double tolerance) {
  std::vector<Index> first(static_cast<std::size_t>(X.rows()));
  std::iota(first.begin(), first.end(), 0);
  for (bool again = true; again;) {
    again = false;
    for (Index v = 0; v < X.rows(); ++v) {
      for (Index w = 0; w < X.rows(); ++w) {
        if ((X.row(v) - X.row(w)).stableNorm() <= tolerance && first[w] < first[v]) {
          first[v] = first[w];
          again = true;
        }
      }
    }
  }
  return first;
}

Points random_points(Index count, double size, const Vec3& at, std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-size, size);
  Points X(count, 3);
  for (double& x : X.reshaped()) {
    x = coordinate(random);
  }
  return X.rowwise() + at.transpose();
}

TEST(Weld, VerticesThatAChainJoinsBecomeTheFirstOfThem) {
  std::mt19937 random(1);
  for (const double size : {1e-300, 1e-8, 1.0, 1e8, 1e300}) {
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1e3, -1e3, 7)}) {
      const Points X = random_points(200, size, size * at, random);
      for (const double share : {1e-3, 0.05, 0.1, 0.2, 0.5, 10.0}) {
        const std::vector<Index> expected = joined_directly(X, share * size);
        const Weld weld = find_close_vertices(X, share * size);
        ASSERT_EQ(weld.vertex.size(), 200u);
        for (Index v = 0; v < 200; ++v) {
          EXPECT_EQ(weld.first[weld.vertex[v]], expected[v]) << size << " " << share;
        }
        EXPECT_TRUE(std::ranges::is_sorted(weld.first));
      }
    }
  }
}

TEST(Weld, WhichVerticesAreMergedDoesNotDependOnTheirOrder) {
  std::mt19937 random(2);
  const Points X = random_points(300, 1, Vec3::Zero(), random);
  const Weld weld = find_close_vertices(X, 0.15);
  EXPECT_LT(weld.first.size(), 300u);
  std::vector<Index> order(300);
  std::iota(order.begin(), order.end(), 0);
  for (int shuffle = 0; shuffle < 5; ++shuffle) {
    std::ranges::shuffle(order, random);
    const Weld other = find_close_vertices(X(order, Eigen::all), 0.15);
    ASSERT_EQ(other.first.size(), weld.first.size());
    for (std::size_t i = 0; i < 300; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_EQ(other.vertex[i] == other.vertex[k],
                  weld.vertex[order[i]] == weld.vertex[order[k]]);
      }
    }
  }
}

TEST(Weld, TinyTolerancesMergeEqualVerticesOnly) {
  std::mt19937 random(3);
  Points X = random_points(100, 1, Vec3::Zero(), random);
  X.row(99) = X.row(0);
  for (const double tolerance : {std::numeric_limits<double>::denorm_min(), 1e-300, 1e-20}) {
    const Weld weld = find_close_vertices(X, tolerance);
    EXPECT_EQ(weld.first.size(), 99u);
    EXPECT_EQ(weld.vertex[99], 0);
  }
  const Points same = Points::Constant(50, 3, 0.3);
  EXPECT_EQ(find_close_vertices(same, 1e-300).first.size(), 1u);
  EXPECT_EQ(find_close_vertices(same, 1e300).first.size(), 1u);
}

TEST(Weld, CollapsedFacesAreLeftOut) {
  Polygons faces;
  const std::vector<std::vector<Index>> all{{0, 0, 1}, {0, 1, 2}, {3, 3, 4, 5},
                                            {1, 2, 1}, {2, 2, 2}, {0, 1, 2, 0}};
  for (const auto& face : all) {
    faces.add(face);
  }
  const KeptFaces kept = remove_collapsed(faces);
  EXPECT_EQ(kept.face, (std::vector<Index>{1, 2, 5}));
  EXPECT_EQ(faces.corner, (std::vector<Index>{0, 1, 2, 3, 4, 5, 1, 2, 0}));
  EXPECT_EQ(kept.corner, (std::vector<std::int64_t>{3, 4, 5, 6, 8, 9, 17, 18, 19}));
}

}  // namespace
}  // namespace ibmfair::test
