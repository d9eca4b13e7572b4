// The connectivity of triangle meshes, and the geometric sizes of meshes.
#include "ibmfair/mesh/topology.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

const NamedMesh& named(const std::vector<NamedMesh>& meshes, const std::string& name) {
  return *std::find_if(meshes.begin(), meshes.end(), [&](const auto& m) { return m.name == name; });
}

Topology topology_of(const Mesh& mesh) {
  return State(mesh).topology;
}

/// The vertices of every hinge, regardless of the order of its edge's ends and of its sides.
std::set<std::pair<std::set<Index>, std::set<Index>>> hinge_set(const Topology& topology) {
  std::set<std::pair<std::set<Index>, std::set<Index>>> set;
  for (const auto x : topology.H.rowwise()) {
    set.insert({{x[0], x[1]}, {x[2], x[3]}});
  }
  return set;
}

TEST(Topology, EveryHalfEdgeIsCountedOnce) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Topology topology = topology_of(mesh);
    std::size_t sides = 0;
    for (Index e = 0; e < topology.E.rows(); ++e) {
      EXPECT_LT(topology.E(e, 0), topology.E(e, 1)) << name;
      sides += topology.edge_triangles[e].size();
    }
    const auto proper =
        topology.F.rows() - static_cast<Eigen::Index>(topology.defects.repeated_corner.size());
    EXPECT_EQ(sides, static_cast<std::size_t>(3 * proper)) << name;
    EXPECT_EQ(topology.stars.value.size(), static_cast<std::size_t>(3 * proper)) << name;
  }
}

TEST(Topology, RingsFollowTheTriangles) {
  Index in_turn = 0, in_order = 0;
  for (const auto& [name, mesh] : all_meshes()) {
    const Topology topology = topology_of(mesh);
    const CompressedRows rings = vertex_rings(topology);
    for (Index v = 0; v < topology.vertex_count; ++v) {
      const auto ring = rings[v];
      std::set<Index> neighbours;
      for (const Index t : topology.stars[v]) {
        const auto others = other_corners(topology.F, t, v);
        neighbours.insert(others.begin(), others.end());
      }
      EXPECT_EQ(std::set<Index>(ring.begin(), ring.end()), neighbours) << name << ' ' << v;
      EXPECT_EQ(ring.size(), neighbours.size()) << name << ' ' << v;
      if (!is_ringed(topology, v)) {
        EXPECT_TRUE(std::is_sorted(ring.begin(), ring.end())) << name << ' ' << v;
        ++in_order;
        continue;
      }
      ++in_turn;
      ASSERT_EQ(ring.size(), topology.stars[v].size()) << name << ' ' << v;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Index a = ring[i], b = ring[(i + 1) % ring.size()];
        const auto star = topology.stars[v];
        EXPECT_EQ(std::count_if(star.begin(), star.end(),
                                [&](Index t) {
                                  return other_corners(topology.F, t, v) == std::array{a, b};
                                }),
                  1)
            << name << ' ' << v;
      }
    }
  }
  EXPECT_GT(in_turn, 0);
  EXPECT_GT(in_order, 0);
}

TEST(Topology, ClosedMeshesHaveNoBoundaryAndTheirGenus) {
  for (const auto& [name, mesh] : closed_meshes()) {
    const Topology topology = topology_of(mesh);
    EXPECT_TRUE(topology.boundary_loops.empty()) << name;
    EXPECT_TRUE(topology.defects.empty()) << name;
    EXPECT_EQ(topology.H.rows(), topology.E.rows()) << name;
    EXPECT_EQ(2 * topology.E.rows(), 3 * topology.F.rows()) << name;
    const bool torus = name.find("torus") != std::string::npos;
    EXPECT_EQ(topology.euler_characteristic(), torus ? 0 : 2 * topology.component_count) << name;
  }
}

TEST(Topology, BoundaryLoopsWalkEveryBoundaryEdgeOnce) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Topology topology = topology_of(mesh);
    std::multiset<std::pair<Index, Index>> walked, boundary;
    for (const BoundaryLoop& loop : topology.boundary_loops) {
      const std::size_t n = loop.vertices.size();
      for (std::size_t i = 0; i + (loop.closed ? 0 : 1) < n; ++i) {
        walked.insert(std::minmax(loop.vertices[i], loop.vertices[(i + 1) % n]));
      }
    }
    for (Index e = 0; e < topology.E.rows(); ++e) {
      if (topology.edge_triangles[e].size() == 1) {
        boundary.insert({topology.E(e, 0), topology.E(e, 1)});
      }
    }
    EXPECT_EQ(walked, boundary) << name;
  }
}

TEST(Topology, CountsLoopsOfKnownSurfaces) {
  const auto open = open_meshes();
  for (const auto& [name, mesh] : open) {
    const bool two =
        name.find("annulus") != std::string::npos || name.find("cylinder") != std::string::npos;
    EXPECT_EQ(topology_of(mesh).boundary_loops.size(), two ? 2U : 1U) << name;
  }
  const Topology strip = topology_of(nonorientable_meshes()[0].mesh);
  ASSERT_EQ(strip.boundary_loops.size(), 1U);
  EXPECT_TRUE(strip.boundary_loops[0].closed);
  EXPECT_TRUE(strip.boundary_loops[0].simple);
}

TEST(Topology, OrientationInTheFileDoesNotMatter) {
  for (const auto& [name, mesh] : all_meshes()) {
    const Topology as_is = topology_of(in_triangles(mesh));
    const Topology mixed = topology_of(with_mixed_orientation(in_triangles(mesh)));
    EXPECT_EQ(hinge_set(as_is), hinge_set(mixed)) << name;
    EXPECT_EQ(as_is.orientable, mixed.orientable) << name;
    EXPECT_EQ(as_is.boundary_loops.size(), mixed.boundary_loops.size()) << name;
    EXPECT_EQ(as_is.defects.count(), mixed.defects.count()) << name;
  }
}

TEST(Topology, NeighboursAgreeAfterOrienting) {
  for (const auto& [name, mesh] : good_meshes()) {
    const Topology topology = topology_of(with_mixed_orientation(mesh));
    EXPECT_TRUE(topology.orientable) << name;
    for (Index h = 0; h < topology.H.rows(); ++h) {
      const auto x = topology.H.row(h);
      EXPECT_TRUE(runs_along(topology.F, topology.hinge_triangles(h, 0), x[0], x[1])) << name;
      EXPECT_TRUE(runs_along(topology.F, topology.hinge_triangles(h, 1), x[1], x[0])) << name;
    }
  }
}

TEST(Topology, KeepsTheOrientationOfTheMajority) {
  for (const auto& [name, mesh] : closed_meshes()) {
    const State state(mesh);
    EXPECT_EQ(state.topology.turned_triangles, 0) << name;
    EXPECT_GT(enclosed_volume(state.X, state.topology.F), 0) << name;
  }
}

TEST(Topology, FindsTheCutOfNonOrientableSurfaces) {
  for (const auto& [name, mesh] : nonorientable_meshes()) {
    const Topology topology = topology_of(mesh);
    EXPECT_FALSE(topology.orientable) << name;
    EXPECT_TRUE(topology.defects.empty()) << name;
    EXPECT_NE(std::count(topology.twisted.begin(), topology.twisted.end(), 1), 0) << name;
  }
}

TEST(Topology, NamesEachKindOfDefect) {
  const auto meshes = defective_meshes();
  const auto defects = [&](const char* name) {
    return topology_of(named(meshes, name).mesh).defects;
  };
  EXPECT_EQ(defects("bow tie").bow_tie_vertices.size(), 1U);
  EXPECT_EQ(defects("non-manifold edge").non_manifold_edges.size(), 1U);
  EXPECT_FALSE(defects("zero area").zero_area.empty());
  EXPECT_FALSE(defects("repeated corner").repeated_corner.empty());
  EXPECT_EQ(defects("duplicate face").duplicate.size() % 2, 0U);
  EXPECT_FALSE(defects("duplicate face").duplicate.empty());
  EXPECT_TRUE(defects("isolated vertex").empty());
  const Topology isolated = topology_of(named(meshes, "isolated vertex").mesh);
  EXPECT_NE(std::count(isolated.kind.begin(), isolated.kind.end(), VertexKind::isolated), 0);
}

TEST(Topology, DefectsCarryNoHinge) {
  for (const auto& [name, mesh] : defective_meshes()) {
    const Topology topology = topology_of(mesh);
    for (Index h = 0; h < topology.H.rows(); ++h) {
      for (const Index t : topology.hinge_triangles.row(h)) {
        EXPECT_TRUE(topology.usable[t]) << name;
      }
      EXPECT_NE(topology.H(h, 2), topology.H(h, 3)) << name;
    }
    EXPECT_EQ(topology.defects.empty(),
              std::count(topology.defective.begin(), topology.defective.end(), 1) == 0)
        << name;
  }
}

/// A ring of `size` triangles around the last vertex, without the triangles in `missing`.
Triangles wheel(Index size, const std::set<Index>& missing) {
  Triangles F(size - static_cast<Index>(missing.size()), 3);
  Eigen::Index row = 0;
  for (Index i = 0; i < size; ++i) {
    if (!missing.contains(i)) {
      F.row(row++) << size, i, (i + 1) % size;
    }
  }
  return F;
}

TEST(Topology, HubsOfAnySizeAreToldFromBowTies) {
  for (const Index size : {6, 32, 33, 500}) {
    const auto kind_of_hub = [&](const std::set<Index>& missing) {
      return build_topology(size + 1, wheel(size, missing)).kind[size];
    };
    EXPECT_EQ(kind_of_hub({}), VertexKind::interior) << size;
    EXPECT_EQ(kind_of_hub({2}), VertexKind::boundary) << size;
    EXPECT_EQ(kind_of_hub({2, 4}), VertexKind::irregular) << size;
    const Topology topology = build_topology(size + 1, wheel(size, {2, 4}));
    EXPECT_EQ(topology.defects.bow_tie_vertices, std::vector<Index>{size}) << size;
    EXPECT_EQ(topology.boundary_loops.size(), 2U) << size;
  }
}

TEST(Topology, TwoTrianglesOverTheSameVerticesAreDuplicates) {
  for (const Index last : {1, 2}) {  // a pillow, and a triangle folded onto itself
    const Triangles F = (Triangles(2, 3) << 0, 1, 2, 0, 3 - last, last).finished();
    const Topology topology = build_topology(3, F);
    EXPECT_EQ(topology.defects.duplicate, (std::vector<Index>{0, 1}));
    EXPECT_EQ(topology.H.rows(), 0);
    EXPECT_EQ(topology.turned_triangles, last == 1 ? 0 : 1);
  }
}

TEST(Topology, GrowsByOneRing) {
  const Topology topology = topology_of(flat_sheet(6, 6));
  std::vector<std::uint8_t> set(topology.vertex_count, 0);
  set[24] = 1;  // the centre of 7 x 7 vertices
  set = grow_one_ring(topology, set);
  EXPECT_EQ(std::count(set.begin(), set.end(), 1), 7);  // itself and six neighbours
}

TEST(Geometry, SizesScaleAndDoNotMove) {
  for (const auto& [name, mesh] : good_meshes()) {
    SCOPED_TRACE(name);
    const State state(mesh);
    const State other(moved(mesh, 3.0, Vec3(5, -7, 11)));
    const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * std::abs(b)); };
    near(surface_area(other.X, other.topology.F), 9 * surface_area(state.X, state.topology.F));
    near(mean_edge_length(other.X, other.topology.E),
         3 * mean_edge_length(state.X, state.topology.E));
    near(lumped_vertex_mass(other.X, other.topology).sum(),
         surface_area(other.X, other.topology.F));
    if (state.topology.boundary_loops.empty()) {
      near(enclosed_volume(other.X, other.topology.F),
           27 * enclosed_volume(state.X, state.topology.F));
    }
  }
}

TEST(Geometry, FlatHingesAreOpenAndCubeEdgesAreRight) {
  const State sheet(flat_sheet(4, 3));
  EXPECT_NEAR(dihedral_angles(sheet.X, sheet.topology.H).minCoeff(), std::numbers::pi, 1e-12);
  EXPECT_NEAR(smallest_angle(sheet.X, sheet.topology.F), std::atan(0.75), 1e-12);
}

TEST(Geometry, TheSmallestAngleIsThatOfAllTriangles) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const double smallest = smallest_angles(state.X, state.topology.F).minCoeff();
    EXPECT_DOUBLE_EQ(smallest_angle(state.X, state.topology.F), smallest) << name;
  }
  Triangles without_area(1, 3), none(0, 3);
  without_area << 0, 1, 1;
  EXPECT_EQ(smallest_angle(Points::Identity(3, 3), without_area), 0);
  EXPECT_EQ(smallest_angle(Points(0, 3), none), 0);
}

TEST(Geometry, NeedlesAreTheTrianglesWithASmallerAngle) {
  for (const auto& [name, mesh] : all_meshes()) {
    const State state(mesh);
    const Eigen::VectorXd angles = smallest_angles(state.X, state.topology.F);
    for (const double angle : {0.01, 0.3, 0.6, 1.0}) {
      std::vector<Index> smaller;
      for (Index t = 0; t < angles.size(); ++t) {
        if (angles[t] < angle) smaller.push_back(t);
      }
      EXPECT_EQ(needles(state.X, state.topology.F, angle), smaller) << name;
    }
  }
}

TEST(Geometry, TrianglesWithoutDigitsAreDegenerate) {
  Points X(3, 3);
  X << 0, 0, 0, 1, 0, 0, 0.5, 1e-9, 0;
  Triangles F(1, 3);
  F << 0, 1, 2;
  EXPECT_TRUE(degenerate_triangles(X, F).empty());
  EXPECT_TRUE(degenerate_triangles(Points(1e-30 * X), F).empty());
  X.array() += 1e9;  // the height is below the spacing of doubles there
  EXPECT_EQ(degenerate_triangles(X, F).size(), 1U);
}

}  // namespace
}  // namespace ibmfair::test
