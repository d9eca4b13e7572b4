// The kernels process the rings of several vertices at a time. Their results agree with those of
// each vertex by itself.
#include "ibmfair/flow/steps/ring_kernels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/flow/mesh_parts.h"
#include "ibmfair/flow/steps/distortion.h"
#include "ibmfair/mesh/geometry.h"
#include "support/kernel_sets.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double rounding = 1e-13;

/// A state with some of its vertices fixed, and the rings of its vertices.
struct WithFixedVertices {
  State state;
  CompressedRows rings;
  Unknowns unknowns;
  RingGroups groups;

  explicit WithFixedVertices(const Mesh& mesh)
      : state(mesh),
        rings(vertex_rings(state.topology)),
        unknowns(every_fifth(state.topology.vertex_count)),
        groups(state.topology, rings, unknowns) {}

  static std::vector<std::uint8_t> every_fifth(Index count) {
    std::vector<std::uint8_t> fixed(static_cast<std::size_t>(count), 0);
    for (Index v = 0; v < count; v += 5) {
      fixed[v] = 1;
    }
    return fixed;
  }
};

template <class Check>
void for_all_meshes(const Check& check) {
  for (const auto& [name, mesh] : all_meshes()) {
    SCOPED_TRACE(name);
    check(WithFixedVertices(mesh));
  }
}

TEST(RingGroups, HaveEveryVertexNearAnUnknownOnce) {
  for_all_meshes([](const WithFixedVertices& mesh) {
    std::vector<Index> found = mesh.groups.others;
    for (std::int64_t part = 0; part < mesh.groups.parts(); ++part) {
      RingRange(mesh.groups, part).for_each([&](Index v, std::int64_t) { found.push_back(v); });
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (const Index v : mesh.unknowns.vertex) {
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), v)) << v;
    }
  });
}

TEST(RingKernels, FindTheNormalsAndTheMeans) {
  for_all_meshes([](const WithFixedVertices& mesh) {
    const Topology& topology = mesh.state.topology;
    const Points& X = mesh.state.X;
    for (std::int64_t part = 0; part < mesh.groups.parts(); ++part) {
      const RingRange range(mesh.groups, part);
      ForPart<Surroundings> results;
      find_surroundings(range, X, results);
      range.for_each([&](Index v, std::int64_t i) {
        Vec3 normal = Vec3::Zero(), mean = Vec3::Zero();
        double lengths = 0;
        for (const Index t : topology.stars[v]) {
          const Vec3 N = double_area_vector(X, topology.F, t);
          normal += N;
          lengths += N.norm();
        }
        for (const Index q : mesh.rings[v]) {
          mean += X.row(q) / static_cast<double>(mesh.rings[v].size());
        }
        const Vec3 half_way = (mean - X.row(v).transpose()) / 2;
        const double left = lengths > 0 ? normal.norm() / lengths : 0;
        const double size = half_way.norm() + X.row(v).norm();
        EXPECT_LE((results[i].normal.xyz() - normal).norm(), rounding * lengths);
        EXPECT_NEAR(results[i].normal.w, left, rounding);
        EXPECT_LE((results[i].half_way.xyz() - half_way).norm(), rounding * size);
        if (left > 0.1) {
          const Vec3 n = normal.normalized();
          EXPECT_LE((results[i].along.xyz() - (half_way - n.dot(half_way) * n)).norm(),
                    100 * rounding * size);
        }
      });
    }
  });
}

/// The distortion as distortion.h defines it, computed edge by edge.
double distortion(const WithFixedVertices& mesh, const Points& step, const PerVertex& edge_length) {
  const auto move = [&](Index v) -> Vec3 {
    const Index u = mesh.unknowns.unknown[v];
    return u >= 0 ? Vec3(step.row(u)) : Vec3(Vec3::Zero());
  };
  double strain = 0, edges = 0, roughness = 0;
  for (const auto& e : mesh.state.topology.E.rowwise()) {
    if (mesh.unknowns.unknown[e[0]] >= 0 || mesh.unknowns.unknown[e[1]] >= 0) {
      strain += (move(e[0]) - move(e[1])).squaredNorm() * 2 /
                (std::pow(edge_length[e[0]], 2) + std::pow(edge_length[e[1]], 2));
      ++edges;
    }
  }
  for (const Index v : mesh.unknowns.vertex) {
    Vec3 own = move(v);
    for (const Index q : mesh.rings[v]) {
      own -= move(q) / static_cast<double>(mesh.rings[v].size());
    }
    roughness += own.squaredNorm() / std::pow(edge_length[v], 2);
  }
  return std::max(std::sqrt(roughness / mesh.unknowns.size()) / 0.15,
                  std::sqrt(strain / edges) / 0.4);
}

TEST(Distortion, IsTheLargerOfRoughnessAndStrain) {
  for_all_meshes([](const WithFixedVertices& mesh) {
    const PerVertex edge_length =
        local_edge_length(mesh.state.X, mesh.rings).array() + 0.01;  // lone vertices have no edges
    const Points rough = random_directions(mesh.unknowns.size());
    const Points smooth = mesh.state.X(mesh.unknowns.vertex, Eigen::all);
    Distortion measure(mesh.groups, mesh.unknowns, MeshParts::one());
    for (const Points& step : {rough, smooth}) {
      Points own;
      const double expected = distortion(mesh, step, edge_length);
      EXPECT_NEAR(measure.of(step, edge_length, own), expected, 1e-12 * expected);
    }
  });
}

TEST(RingKernels, Avx2GivesTheBytesOfTheBaseline) {
  SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
  for_all_meshes([](const WithFixedVertices& mesh) {
    const PerVertex edge_length = PerVertex::Ones(mesh.state.topology.vertex_count);
    const Points step = random_directions(mesh.unknowns.size());
    const auto find = [&](InstructionSet set, Points& own) {
      const WithKernelSet chosen(set);
      return Distortion(mesh.groups, mesh.unknowns, MeshParts::one()).of(step, edge_length, own);
    };
    Points baseline, own;
    const double distorts = find(InstructionSet::baseline, baseline);
    EXPECT_EQ(find(InstructionSet::avx2, own), distorts);
    EXPECT_EQ(own, baseline);
  });
}

}  // namespace
}  // namespace ibmfair::test
