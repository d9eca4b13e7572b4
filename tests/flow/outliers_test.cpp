// Outliers are vertices far off the surface that the others form. The tests check which
// vertices count as outliers on smooth shapes, polyhedra and a scan, and where they are moved.
#include "ibmfair/flow/passes/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

std::vector<std::uint8_t> none_of(const Topology& topology) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(topology.vertex_count), 0);
}

double mean_edge(const State& state) {
  return mean_edge_length(state.X, state.topology.E);
}

/// A shape with some of its interior vertices moved in random directions, by 2 to 10 mean edge
/// lengths.
struct Damaged {
  State truth;
  double edge = mean_edge(truth);
  std::vector<Index> moved;
  Points X = truth.X;

  explicit Damaged(const Mesh& mesh) : truth(mesh) {}

  /// About one vertex in `every` moves. If `apart`, none of them are neighbours.
  Damaged(const Mesh& mesh, int every, bool apart) : Damaged(mesh) {
    std::vector<std::uint8_t> taken = none_of(truth.topology);
    for (Index v = 0; v < X.rows(); ++v) {
      const bool near = std::ranges::any_of(rings_[v], [&](Index q) { return taken[q] != 0; });
      if (random_.uniform() * every < 1 && may_move(v) && !(apart && near)) {
        move(v);
        taken[v] = 1;
      }
    }
  }

  /// Groups of three neighbours move, with four rings at least between two groups.
  static Damaged in_groups(const Mesh& mesh) {
    Damaged damaged(mesh);
    std::vector<std::uint8_t> near = none_of(damaged.truth.topology);
    for (Index v = 0; v < damaged.X.rows(); ++v) {
      const std::array<Index, 3> group = {v, damaged.rings_[v][0], damaged.rings_[v][1]};
      if (std::ranges::any_of(group, [&](Index q) { return near[q] || !damaged.may_move(q); })) {
        continue;
      }
      std::ranges::for_each(group, [&](Index q) { damaged.move(q); });
      const std::vector<std::uint8_t> five_rings =
          around(damaged.truth.topology, {group.begin(), group.end()}, 5);
      std::ranges::transform(near, five_rings, near.begin(), std::bit_or<>());
    }
    std::ranges::sort(damaged.moved);
    return damaged;
  }

  Outliers found() const { return find_outliers(X, truth.topology, none_of(truth.topology)); }

  /// Every fifth vertex of each boundary moves along the normal, up and down in turn.
  static Damaged at_rims(const Mesh& mesh) {
    Damaged damaged(mesh);
    const Topology& topology = damaged.truth.topology;
    for (const BoundaryLoop& loop : topology.boundary_loops) {
      for (std::size_t i = 0; i + 5 <= loop.vertices.size(); i += 5) {
        const Index v = loop.vertices[i];
        const double up = i % 2 == 0 ? 1 : -1;
        damaged.move(v, up * double_area_vector_at(v, damaged.truth.X, topology));
      }
    }
    std::ranges::sort(damaged.moved);
    return damaged;
  }

  /// The largest distance of an outlier that was found from the truth, mean edge lengths.
  double largest_error(const Outliers& outliers) const {
    const Points errors = outliers.positions - truth.X(outliers.vertices, Eigen::all);
    return errors.rowwise().norm().maxCoeff() / edge;
  }

 private:
  CompressedRows rings_ = vertex_rings(truth.topology);
  RandomNumbers random_{3};

  bool may_move(Index v) const { return truth.topology.kind[v] == VertexKind::interior; }

  void move(Index v) { move(v, {random_.normal(), random_.normal(), random_.normal()}); }

  void move(Index v, const Vec3& way) {
    X.row(v) += (2 + 8 * random_.uniform()) * edge * way.normalized();
    moved.push_back(v);
  }
};

struct Shape {
  std::string name;
  Mesh mesh;
  double near;  // mean edge lengths; how near to the truth outliers are moved
};

/// Smooth surfaces, closed and open, a polyhedron, whose corners and edges cannot be known where a
/// vertex on them is lost, and a scan.
std::vector<Shape> shapes() {
  return {{"sphere", make_shape("icosphere", {.subdivide = 4}), 0.1},
          {"torus", make_shape("torus", {.rows = 24, .columns = 60}), 0.05},
          {"catenoid", make_shape("catenoid", {}), 0.1},
          {"cube", make_shape("cube", {.subdivide = 4}), 0.8},
          {"scan", read_mesh(project_file("data/bunny.obj")).mesh(), 0.8}};
}

TEST(Outliers, AreNotFoundOnAShape) {
  for (const auto& [name, mesh, near] : shapes()) {
    const State state(mesh);
    EXPECT_TRUE(find_outliers(state.X, state.topology, none_of(state.topology)).empty()) << name;
  }
  for (const auto& [name, mesh] : all_meshes()) {
    const State coarse(mesh);
    EXPECT_TRUE(find_outliers(coarse.X, coarse.topology, none_of(coarse.topology)).empty()) << name;
  }
}

/// A sphere, and beside it ten copies of a piece, whose size is 1.
State sphere_with_debris(const State& piece) {
  constexpr Index copies = 10;
  const State sphere(make_shape("icosphere", {.subdivide = 4}));
  const Index n = piece.topology.vertex_count, m = static_cast<Index>(piece.topology.F.rows());
  Points X(sphere.X.rows() + copies * n, 3);
  Triangles F(sphere.topology.F.rows() + copies * m, 3);
  X.topRows(sphere.X.rows()) = sphere.X;
  F.topRows(sphere.topology.F.rows()) = sphere.topology.F;
  const double size = (piece.X.colwise().maxCoeff() - piece.X.colwise().minCoeff()).norm();
  for (Index i = 0; i < copies; ++i) {
    const auto first = static_cast<Index>(sphere.X.rows() + i * n);
    X.middleRows(first, n) = (piece.X / size).rowwise() + Vec3(5 + 2 * i, 0, 0).transpose();
    F.middleRows(sphere.topology.F.rows() + i * m, m) = piece.topology.F.array() + first;
  }
  return State(mesh_from_triangles(X, F));
}

TEST(Outliers, AreNotFoundInDebris) {
  for (const auto& [name, mesh] : closed_meshes()) {
    const State state = sphere_with_debris(State(mesh));
    EXPECT_TRUE(find_outliers(state.X, state.topology, none_of(state.topology)).empty()) << name;
  }
}

TEST(Outliers, AreNotFoundInNoiseOfOneStrength) {
  for (const auto& [name, mesh, near] : shapes()) {
    const State state(mesh);
    for (const double deviation : {0.05, 0.1, 0.2, 0.4}) {
      Points X = state.X;
      add_noise(X, deviation * mean_edge(state), 1);
      const Outliers outliers = find_outliers(X, state.topology, none_of(state.topology));
      EXPECT_LE(outliers.vertices.size(), 1 + X.rows() / 2000) << name << ", " << deviation;
    }
  }
}

TEST(Outliers, AreFoundAndMovedOntoTheSurface) {
  for (const auto& [name, mesh, near] : shapes()) {
    const Damaged damaged(mesh, 60, true);
    const Outliers outliers = damaged.found();
    ASSERT_GE(damaged.moved.size(), 5) << name;
    EXPECT_EQ(outliers.vertices, damaged.moved) << name;
    EXPECT_LT(damaged.largest_error(outliers), near) << name;
  }
}

TEST(Outliers, AreFoundBesideOthersAndInNoise) {
  for (const auto& [name, mesh, near] : shapes()) {
    Damaged damaged(mesh, 20, false);
    add_noise(damaged.X, 0.03 * damaged.edge, 1);
    const Outliers outliers = damaged.found();
    EXPECT_GE(outliers.vertices.size(), 0.85 * static_cast<double>(damaged.moved.size())) << name;
    EXPECT_TRUE(std::ranges::includes(damaged.moved, outliers.vertices)) << name;
  }
}

TEST(Outliers, AreFoundInGroups) {
  for (const auto& [name, mesh, near] : shapes()) {
    const Damaged damaged = Damaged::in_groups(mesh);
    const Outliers outliers = damaged.found();
    ASSERT_GE(damaged.moved.size(), 9) << name;
    EXPECT_GE(outliers.vertices.size(), 0.9 * static_cast<double>(damaged.moved.size())) << name;
    EXPECT_TRUE(std::ranges::includes(damaged.moved, outliers.vertices)) << name;
  }
}

TEST(Outliers, TurnAndGrowWithTheMesh) {
  const Damaged damaged(make_shape("icosphere", {.subdivide = 4}), 40, false);
  const Outliers outliers = damaged.found();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto moved = [&](const Points& X) -> Points {
    return (1000 * X * turn.transpose()).rowwise() + Vec3(5, 6, 7).transpose();
  };
  const Outliers turned =
      find_outliers(moved(damaged.X), damaged.truth.topology, none_of(damaged.truth.topology));
  EXPECT_EQ(turned.vertices, outliers.vertices);
  EXPECT_LT((turned.positions - moved(outliers.positions)).norm(), 1e-9 * 1000);
}

TEST(Outliers, EndAtTheLeastUmbrellaEnergy) {
  const Damaged damaged(make_shape("torus", {.rows = 24, .columns = 60}), 8, false);
  const Outliers outliers = damaged.found();
  ASSERT_FALSE(outliers.empty());
  const CompressedRows rings = vertex_rings(damaged.truth.topology);
  const auto energy = [&](const Points& positions) {
    Points X = damaged.X;
    X(outliers.vertices, Eigen::all) = positions;
    double sum = 0;
    for (Index v = 0; v < X.rows(); ++v) {
      Vec3 mean = Vec3::Zero();
      for (const Index q : rings[v]) {
        mean += X.row(q).transpose() / static_cast<double>(rings[v].size());
      }
      sum += (mean - X.row(v).transpose()).squaredNorm();
    }
    return sum;
  };
  // The derivative along any direction vanishes, by central differences, which are exact here.
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Points D = 0.1 * damaged.edge * random_directions(outliers.positions.rows(), seed);
    const double up = energy(outliers.positions + D), down = energy(outliers.positions - D);
    EXPECT_GT(std::min(up, down), energy(outliers.positions));
    EXPECT_NEAR((up - down) / (up + down), 0, 1e-6);
  }
}

TEST(Outliers, FixedVerticesStay) {
  const Damaged damaged(make_shape("torus", {.rows = 24, .columns = 60}), 60, true);
  std::vector<std::uint8_t> fixed = none_of(damaged.truth.topology);
  fixed[damaged.moved[1]] = 1;
  std::vector<Index> rest = damaged.moved;
  rest.erase(rest.begin() + 1);
  EXPECT_EQ(find_outliers(damaged.X, damaged.truth.topology, fixed).vertices, rest);
}

/// A flat disc of 12 rings of `around` vertices each, with a cone of this height in the middle.
Mesh disc_with_cone(Index around, double height) {
  constexpr Index ring_count = 12;
  Points X(1 + ring_count * around, 3);
  X.row(0) = Vec3(0, 0, height).transpose();
  std::vector<std::array<Index, 3>> faces;
  for (Index ring = 0; ring < ring_count; ++ring) {
    for (Index i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      const Index a = 1 + ring * around + i, b = 1 + ring * around + (i + 1) % around;
      X.row(a) = (ring + 1) * Vec3(std::cos(angle), std::sin(angle), 0).transpose();
      if (ring == 0) {
        faces.push_back({0, a, b});
      } else {
        faces.push_back({a - around, a, b});
        faces.push_back({a - around, b, b - around});
      }
    }
  }
  Triangles F(static_cast<Eigen::Index>(faces.size()), 3);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    F.row(t) << faces[t][0], faces[t][1], faces[t][2];
  }
  return mesh_from_triangles(X, F);
}

TEST(Outliers, AtRimsAreFoundAndMovedOntoTheSurface) {
  for (const auto& [name, mesh] :
       {NamedMesh{"catenoid", make_shape("catenoid", {})},
        {"disc", disc_with_cone(60, 0)},
        {"ball without a cap", without_cap(sphere(4), 50)},
        {"scan with holes", with_many_holes(read_mesh(project_file("data/bunny.obj")).mesh())}}) {
    for (const double noise : {0.0, 0.03}) {
      Damaged damaged = Damaged::at_rims(mesh);
      add_noise(damaged.X, noise * damaged.edge, 1);
      const Outliers outliers = damaged.found();
      ASSERT_GE(damaged.moved.size(), 9) << name;
      EXPECT_EQ(outliers.vertices, damaged.moved) << name << ", " << noise;
      EXPECT_LT(damaged.largest_error(outliers), 0.6) << name << ", " << noise;
    }
  }
}

TEST(Outliers, TeethOfRimsStay) {
  State disc(disc_with_cone(60, 0));
  const std::vector<Index>& rim = disc.topology.boundary_loops[0].vertices;
  for (std::size_t i = 0; i < rim.size(); i += 3) {
    disc.X.row(rim[i]) *= 1.4;  // five rings
  }
  EXPECT_TRUE(find_outliers(disc.X, disc.topology, none_of(disc.topology)).empty());
}

TEST(Outliers, TipsOfConesStay) {
  for (const Index around : {6, 24, 60}) {
    const State cone(disc_with_cone(around, 3));
    const Outliers outliers = find_outliers(cone.X, cone.topology, none_of(cone.topology));
    EXPECT_TRUE(outliers.empty()) << around;
  }
}

}  // namespace
}  // namespace ibmfair::test
