// The energy of meshes that consist of several blocks, whose triangles are shared out among
// threads.
#include <algorithm>
#include <set>
#include <span>

#include <gtest/gtest.h>

#include "ibmfair/base/threads.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/mesh_blocks.h"
#include "ibmfair/energy/vertex_blocks.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/polyhedra.h"
#include "support/fan_triangles.h"
#include "support/kernel_sets.h"
#include "support/renumbered.h"

namespace ibmfair::test {
namespace {

TriangleMesh rough_torus() {
  GridSize size;
  size.rows = 100;
  size.columns = 90;
  TriangleMesh mesh = make_torus(2, size);
  add_noise(mesh.X, 0.005, 1);
  return mesh;
}

TriangleMesh rough_plane() {
  GridSize size;
  size.rows = 95;
  size.columns = 101;
  TriangleMesh mesh = make_plane(1, size);
  add_noise(mesh.X, 0.001, 1);
  return mesh;
}

struct Evaluation {
  double E, E_alone;
  Points G;
  StencilWeights weights;

  Evaluation(const TriangleMesh& mesh, const BendingModel& model, const EnergyOptions& options) {
    const Topology topology = build_topology(mesh.X, mesh.F);
    const auto energy = model.create(topology, options);
    E = energy->energy_and_gradient(mesh.X, G);
    E_alone = energy->energy(mesh.X);
    energy->linearise(mesh.X, weights);
  }
};

void expect_same_bytes(const Evaluation& a, const Evaluation& b) {
  EXPECT_EQ(a.E, b.E);
  EXPECT_EQ(a.E_alone, b.E_alone);
  EXPECT_EQ(a.G, b.G);
  EXPECT_EQ(a.weights.c, b.weights.c);
  EXPECT_EQ(a.weights.w, b.weights.w);
}

template <class Check>
void for_every_energy(const Check& check) {
  for (const BendingModel& model : bending_models()) {
    for (const bool mass : {true, false}) {
      SCOPED_TRACE(std::string(model.name) + (mass ? "" : " without mass"));
      for (const TriangleMesh& mesh : {rough_torus(), rough_plane()}) {
        check(mesh, model, mass);
      }
    }
  }
}

TEST(EnergyBlocks, ThreadsDoNotChangeAByte) {
  const int before = thread_count();
  for_every_energy([](const TriangleMesh& mesh, const BendingModel& model, bool mass) {
    set_thread_count(1);
    const Evaluation one(mesh, model, {mass, {}});
    for (const int threads : {2, 3}) {
      set_thread_count(threads);
      expect_same_bytes(Evaluation(mesh, model, {mass, {}}), one);
    }
  });
  set_thread_count(before);
}

/// The results differ by rounding only: the baseline rounds products before it adds them.
void expect_avx2_to_agree_with_the_baseline(const TriangleMesh& mesh, const BendingModel& model,
                                            bool mass) {
  const auto evaluate = [&](InstructionSet set) {
    const WithKernelSet chosen(set);
    return Evaluation(mesh, model, {mass, {}});
  };
  const Evaluation avx2 = evaluate(InstructionSet::avx2);
  const Evaluation baseline = evaluate(InstructionSet::baseline);
  EXPECT_NEAR(baseline.E, avx2.E, 1e-13 * avx2.E);
  EXPECT_NEAR(baseline.E_alone, avx2.E_alone, 1e-13 * avx2.E);
  EXPECT_LE((baseline.G - avx2.G).norm(), 1e-13 * avx2.G.norm());
}

TEST(EnergyBlocks, Avx2AgreesWithTheBaselineToRounding) {
  SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
  for_every_energy(expect_avx2_to_agree_with_the_baseline);
}

// In small meshes the kernels meet a vertex several times at once.
TEST(EnergyBlocks, Avx2AgreesWithTheBaselineInSmallMeshes) {
  SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
  for (const BendingModel& model : bending_models()) {
    for (const int level : {0, 1, 2, 3}) {
      SCOPED_TRACE(std::string(model.name) + ", level " + std::to_string(level));
      TriangleMesh mesh = make_icosphere({level, {}});
      add_noise(mesh.X, 0.01, 1);
      expect_avx2_to_agree_with_the_baseline(mesh, model, true);
    }
  }
}

TEST(EnergyBlocks, TheNumberingOfTheInputDoesNotMatter) {
  for_every_energy([](const TriangleMesh& mesh, const BendingModel& model, bool mass) {
    std::vector<std::uint8_t> active(static_cast<std::size_t>(mesh.X.rows()), 0);
    std::fill(active.begin() + 1000, active.begin() + 6000, 1);
    const std::vector<Index> number = permutation(mesh.X.rows(), 3);
    std::vector<std::uint8_t> other_active(active.size());
    for (std::size_t v = 0; v < active.size(); ++v) {
      other_active[number[v]] = active[v];
    }
    const Evaluation here(mesh, model, {mass, active});
    const Evaluation there(renumbered(mesh, number), model, {mass, other_active});
    EXPECT_NEAR(there.E, here.E, 1e-12 * here.E);
    EXPECT_LE((there.G(number, Eigen::all) - here.G).norm(), 1e-12 * here.G.norm());
  });
}

/// The number of triangles that are not the filler's.
std::int64_t count_real(const CornerTriples& triangles) {
  return std::count_if(triangles.begin(), triangles.end(),
                       [](const auto& x) { return x[1] >= filler_vertices; });
}

TEST(EnergyBlocks, EveryTriangleIsOwnedOnceAndFewAreRepeated) {
  for (const bool in_order : {true, false}) {
    TriangleMesh mesh = make_icosphere({5, {}});
    if (!in_order) {
      mesh = renumbered(mesh, permutation(mesh.X.rows(), 4));
    }
    const Topology topology = build_topology(mesh.X, mesh.F);
    const MeshBlocks blocks =
        mesh_blocks(topology, std::vector<std::uint8_t>(topology.usable.size(), 1));
    std::int64_t own = 0, all = 0;
    for (const MeshBlock& b : blocks.block) {
      for (std::int64_t g = 0; g < b.groups; ++g) {
        const auto count = count_real(triangles_of(b.fans[g], b.corners, vertex_size));
        own += g < b.own_groups ? count : 0;
        all += count;
      }
    }
    const auto count = static_cast<std::int64_t>(mesh.F.rows());
    EXPECT_EQ(own, count);
    EXPECT_LT(static_cast<double>(all), 1.2 * static_cast<double>(count));
    std::vector<Index> vertices = blocks.owned;
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(std::adjacent_find(vertices.begin(), vertices.end()), vertices.end());
    EXPECT_EQ(static_cast<Eigen::Index>(vertices.size()), mesh.X.rows());
  }
}

TEST(EnergyBlocks, AMeshThatIsNumberedByItsBlocksHasTheSameOnes) {
  const TriangleMesh mesh = make_icosphere({5, {}});
  const std::vector<std::uint8_t> all(mesh.F.rows(), 1);
  const CompressedRows blocks = vertex_blocks(build_topology(mesh.X, mesh.F), all);
  ASSERT_GT(blocks.size(), 2);
  std::vector<Index> number(blocks.value.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    number[blocks.value[i]] = static_cast<Index>(i);
  }
  const TriangleMesh there = renumbered(mesh, number);
  const CompressedRows runs = vertex_blocks(build_topology(there.X, there.F), all);
  EXPECT_EQ(runs.first, blocks.first);
  EXPECT_TRUE(std::is_sorted(runs.value.begin(), runs.value.end()));
  EXPECT_EQ(runs.value.size(), number.size());
}

TEST(EnergyBlocks, WholeStarsMissNoTriangleOfACorner) {
  const TriangleMesh mesh = rough_torus();
  const Topology topology = build_topology(mesh.X, mesh.F);
  std::vector<std::uint8_t> kept(topology.usable.size(), 1);
  std::fill(kept.begin() + 5000, kept.begin() + 7000, 0);
  const MeshBlocks blocks = mesh_blocks(topology, kept, {.whole_stars = true});
  ASSERT_GT(blocks.block.size(), 1);
  for (const MeshBlock& b : blocks.block) {
    std::vector<Index> vertex(blocks.owned_of(b).begin(), blocks.owned_of(b).end());
    vertex.insert(vertex.end(), b.halo.begin(), b.halo.end());
    std::vector<int> triangles(filler_vertices + vertex.size(), 0);
    for (std::int64_t g = 0; g < b.outer_groups; ++g) {
      for (const auto& corners : triangles_of(b.fans[g], b.corners, vertex_size)) {
        for (const Index v : corners) {
          ++triangles[v];
          EXPECT_TRUE(g >= b.groups || v < filler_vertices + b.owned + b.rim);
        }
      }
    }
    for (Index i = 0; i < b.owned + b.rim; ++i) {
      const auto star = topology.stars[vertex[i]];
      EXPECT_EQ(triangles[filler_vertices + i],
                std::count_if(star.begin(), star.end(), [&](Index t) { return kept[t] != 0; }));
    }
  }
}

TEST(EnergyBlocks, LinesHoldEachRowOfABlockAndComeOnce) {
  const TriangleMesh mesh = make_icosphere({5, {}});
  const Topology topology = build_topology(mesh.X, mesh.F);
  const MeshBlocks blocks =
      mesh_blocks(topology, std::vector<std::uint8_t>(topology.usable.size(), 1));
  for (const MeshBlock& b : blocks.block) {
    std::set<std::int64_t> lines;
    const auto add_rows = [&](std::span<const Index> vertices) {
      for (const Index v : vertices) {
        for (const int k : {0, 1, 2}) {
          lines.insert((3 * std::int64_t{v} + k) / numbers_per_line);
        }
      }
    };
    add_rows(blocks.owned_of(b));
    EXPECT_EQ(std::set<std::int64_t>(b.own_lines().begin(), b.own_lines().end()), lines);
    EXPECT_EQ(b.own_lines().size(), lines.size());
    add_rows(b.halo);
    EXPECT_EQ(std::set<std::int64_t>(b.lines.begin(), b.lines.end()), lines);
    EXPECT_EQ(b.lines.size(), lines.size());
  }
}

}  // namespace
}  // namespace ibmfair::test
