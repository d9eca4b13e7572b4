// Covers of a mesh's triangles with fans, in the form that the energy kernels take.
#include "ibmfair/energy/triangle_fans.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/energy/mesh_blocks.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/polyhedra.h"
#include "support/fan_triangles.h"
#include "support/meshes.h"

namespace ibmfair::test {
namespace {

constexpr Index place_of_vertex = 5;

struct Fans {
  std::vector<Index> places;
  std::vector<FanGroup> groups;
};

/// The triangles of F, with their vertices numbered after the vertices of the filler.
CornerTriples triples(const Triangles& F) {
  CornerTriples result;
  for (const auto& x : F.rowwise()) {
    if (x[0] != x[1] && x[1] != x[2] && x[2] != x[0]) {
      result.push_back({filler_vertices + x[0], filler_vertices + x[1], filler_vertices + x[2]});
    }
  }
  return result;
}

Fans cover(const CornerTriples& triangles, Index vertex_count) {
  Fans fans;
  FanCover().append(triangles, {}, filler_vertices + vertex_count, place_of_vertex, fans.places,
                    fans.groups);
  return fans;
}

/// The triangle turned so that it begins with its smallest corner.
std::array<Index, 3> turned(std::array<Index, 3> x) {
  std::rotate(x.begin(), std::min_element(x.begin(), x.end()), x.end());
  return x;
}

/// The triangles that the fans list, sorted; the triangles of the filler are listed apart.
struct Listed {
  CornerTriples triangles, fillers;
};

Listed listed(const Fans& fans) {
  Listed result;
  for (const FanGroup& group : fans.groups) {
    for (const auto& corners : triangles_of(group, fans.places, place_of_vertex)) {
      const auto x = turned(corners);
      (x[2] < filler_vertices ? result.fillers : result.triangles).push_back(x);
    }
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

void expect_each_once(const CornerTriples& triangles, Index vertex_count) {
  const Fans fans = cover(triangles, vertex_count);
  CornerTriples expected = triangles;
  std::transform(expected.begin(), expected.end(), expected.begin(), turned);
  std::sort(expected.begin(), expected.end());
  const Listed found = listed(fans);
  EXPECT_EQ(found.triangles, expected);
  EXPECT_LE(found.fillers.size(), longest_fan * fans_per_group / 2);
  for (const auto& x : found.fillers) {
    EXPECT_EQ(x[0], 0);
    EXPECT_EQ(x[2], x[1] + 1);
  }
  std::int64_t rows = 0, places = 0;
  for (const FanGroup& group : fans.groups) {
    EXPECT_LE(group.triangles, longest_fan);
    EXPECT_EQ(group.first_row, rows);
    EXPECT_EQ(group.first_place, places);
    rows += group.triangles + 1;
    places += fans_per_group * (std::int64_t{group.triangles} + 2);
  }
  EXPECT_EQ(static_cast<std::int64_t>(fans.places.size()), places);
}

TEST(TriangleFans, CoverEveryTriangleOnceAsItIsOriented) {
  for (const auto& [name, mesh] : all_meshes()) {
    SCOPED_TRACE(name);
    const auto vertices = static_cast<Index>(mesh.X.rows());
    expect_each_once(triples(triangulate(mesh).F), vertices);
    expect_each_once(triples(triangulate(with_mixed_orientation(mesh)).F), vertices);
  }
}

TEST(TriangleFans, CutLongOnes) {
  for (const Index around : {8, 9, 16, 100}) {
    const Mesh mesh = barrel(around);
    expect_each_once(triples(triangulate(mesh).F), static_cast<Index>(mesh.X.rows()));
  }
}

TEST(TriangleFans, OfNothingAreNone) {
  EXPECT_TRUE(cover({}, 0).groups.empty());
}

/// For each triangle, the triangles behind its edges that run along the edge in the other
/// direction. Every third edge is left out.
CornerTriples some_beside(const CornerTriples& triangles) {
  std::map<std::pair<Index, Index>, Index> runs_along;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      runs_along[{triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]}] = static_cast<Index>(t);
    }
  }
  CornerTriples beside;
  for (const auto& x : triangles) {
    std::array<Index, 3> behind{-1, -1, -1};
    for (int i = 0; i < 3; ++i) {
      const Index a = x[(i + 1) % 3], b = x[(i + 2) % 3];
      const auto other = runs_along.find({b, a});
      if (other != runs_along.end() && (a + b) % 3 != 0) {
        behind[i] = other->second;
      }
    }
    beside.push_back(behind);
  }
  return beside;
}

TEST(TriangleFans, GoOnOnlyToTheTriangleThatIsNamed) {
  for (const auto& [name, mesh] : all_meshes()) {
    SCOPED_TRACE(name);
    const CornerTriples triangles = triples(triangulate(mesh).F);
    const CornerTriples beside = some_beside(triangles);
    Fans fans;
    FanCover cover;
    cover.append(triangles, beside, filler_vertices + static_cast<Index>(mesh.X.rows()),
                 place_of_vertex, fans.places, fans.groups);
    const Index* listed = cover.listed().data();
    std::size_t found = 0;
    for (const FanGroup& group : fans.groups) {
      const CornerTriples in_fans = triangles_of(group, fans.places, place_of_vertex);
      for (Index fan = 0; fan < fans_per_group; ++fan) {
        for (Index i = 0; i < group.triangles; ++i) {
          const Index place = listed[fans_per_group * i + fan];
          if (place < 0) {
            continue;
          }
          ++found;
          std::array<Index, 3> x = triangles[place / 3];
          std::rotate(x.begin(), x.begin() + place % 3, x.end());
          EXPECT_EQ(in_fans[fan * group.triangles + i], x);
          if (i > 0) {
            const Index before = listed[fans_per_group * (i - 1) + fan];
            EXPECT_EQ(beside[before / 3][(before + 1) % 3], place / 3);
          }
        }
      }
      listed += std::ptrdiff_t{fans_per_group} * group.triangles;
    }
    EXPECT_EQ(found, triangles.size());
  }
}

// A cover keeps nothing of the triangles of earlier calls.
TEST(TriangleFans, AppendToWhatIsThere) {
  const TriangleMesh mesh = make_icosphere({2, {}});
  const CornerTriples all = triples(mesh.F), half(all.begin(), all.begin() + all.size() / 2),
                      rest(all.begin() + all.size() / 2, all.end());
  const auto vertices = static_cast<Index>(filler_vertices + mesh.X.rows());
  FanCover cover;
  Fans together, apart[2];
  cover.append(half, {}, vertices, place_of_vertex, together.places, together.groups);
  cover.append(rest, {}, vertices, place_of_vertex, together.places, together.groups);
  cover.append(half, {}, vertices, place_of_vertex, apart[0].places, apart[0].groups);
  cover.append(rest, {}, vertices, place_of_vertex, apart[1].places, apart[1].groups);
  CornerTriples both = listed(apart[0]).triangles;
  const CornerTriples second = listed(apart[1]).triangles;
  both.insert(both.end(), second.begin(), second.end());
  std::sort(both.begin(), both.end());
  EXPECT_EQ(listed(together).triangles, both);
}

// In these meshes six triangles meet at nearly all vertices. Fans that are whole stars, 8 places
// for 6 triangles, leave few gaps. Separate triangles would take 3 places each.
TEST(TriangleFans, AreLong) {
  GridSize size;
  size.rows = 40;
  size.columns = 50;
  for (const TriangleMesh& mesh :
       {make_icosphere({4, {}}), make_torus(2, size), make_plane(1, size)}) {
    const Fans fans = cover(triples(mesh.F), static_cast<Index>(mesh.X.rows()));
    EXPECT_LT(static_cast<double>(fans.places.size()), 1.6 * static_cast<double>(mesh.F.rows()));
  }
}

}  // namespace
}  // namespace ibmfair::test
