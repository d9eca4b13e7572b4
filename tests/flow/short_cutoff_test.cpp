// As the cut-off goes to 0, so do all moves: of the flow, of tangential relaxation, and of what
// mends foldovers and spikes.
#include "ibmfair/flow/short_cutoff.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/angle.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/noise.h"
#include "support/files.h"
#include "support/flow_run.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The longest move over the mean edge length.
double longest_move(const State& state, double cutoff, const FlowOptions& options) {
  const FlowRun run = run_flow(state, cutoff, options);
  return (run.X - state.X).rowwise().norm().maxCoeff() /
         mean_edge_length(state.X, state.topology.E);
}

/// A move is bounded by a constant times the square of the cut-off, which relaxation falls with.
void expect_short_moves(const State& state) {
  constexpr double most = 3;
  for (const auto& [laplacian, sharp_angle] :
       {std::tuple("crouzeix-raviart", 0.0), std::tuple("crouzeix-raviart", radians(20)),
        std::tuple("lagrange", 0.0), std::tuple("umbrella", 0.0)}) {
    SCOPED_TRACE(laplacian + std::string(sharp_angle > 0 ? ", creases kept" : ""));
    const FlowOptions options{.laplacian = laplacian, .sharp_angle = sharp_angle};
    for (const double cutoff : {0.01, 0.1, 0.5}) {
      EXPECT_LE(longest_move(state, cutoff, options), most * cutoff * cutoff) << cutoff;
    }
  }
}

TEST(ShortCutoff, MovesLittleOnAllMeshes) {
  for (const NamedMesh& mesh : good_meshes()) {
    SCOPED_TRACE(mesh.name);
    expect_short_moves(State(mesh.mesh));
    State rough(mesh.mesh);
    add_noise(rough.X, 0.3 * mean_edge_length(rough.X, rough.topology.E), 1);
    expect_short_moves(rough);
  }
}

TEST(ShortCutoff, MovesLittleOnRealMeshes) {
  for (const std::string& path : project_meshes()) {
    SCOPED_TRACE(path);
    expect_short_moves(State(read_mesh(path).mesh()));
  }
}

/// The largest distance of a moved vertex from the plane of a triangle at it, over the mean edge
/// length: 0 for vertices that stay in their faces, on their creases and in their corners.
double farthest_off_faces(const State& state, const Points& X) {
  double farthest = 0;
  for (Index t = 0; t < state.topology.F.rows(); ++t) {
    const Vec3 normal = double_area_vector(state.X, state.topology.F, t).normalized();
    for (const Index v : state.topology.F.row(t)) {
      farthest = std::max(farthest, std::abs((X.row(v) - state.X.row(v)).dot(normal)));
    }
  }
  return farthest / mean_edge_length(state.X, state.topology.E);
}

// The flow itself leaves the faces by the fourth power of the cut-off; relaxation does not.
TEST(ShortCutoff, LeavesVerticesOfCoarsePartsOnTheirCreasesAndCorners) {
  const auto engraved = [](Index i, Index j, Index k) {
    return k != 3 || !((i == 2 && j >= 1 && j <= 4) || (j == 1 && i >= 2 && i <= 4));
  };
  std::vector<Mesh> parts{solid_of_cells({0, 4, 6, 8, 12, 16, 20}, {0, 4, 8, 10, 14, 17, 20},
                                         {0, 7, 14, 18, 20}, engraved),
                          tray(4, 3, 1), angle_profile(4, 6, 1), plate(5, 3, 2),
                          read_mesh(project_file("tests/flow/reported/pk_7.off")).mesh()};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const State state(parts[i]);
    for (const double cutoff : {0.01, 0.1, 0.3}) {
      const FlowRun run = run_flow(state, cutoff, {});
      EXPECT_LE(farthest_off_faces(state, run.X), 5 * std::pow(cutoff, 4)) << i << " " << cutoff;
    }
  }
}

TEST(ShortCutoff, IsBelowTwoEdges) {
  const State state(barrel(12));
  const double edge = mean_edge_length(state.X, state.topology.E);
  for (const char* laplacian : {"crouzeix-raviart", "lagrange", "umbrella"}) {
    for (const double cutoff : {0.1, 0.9, 1.1, 1.9, 2.0, 8.0}) {
      FlowOptions options{.laplacian = laplacian};
      options.total_time =
          time_in_flow_units(time_for_cutoff(cutoff * edge), state.X, state.topology, options);
      const auto gentle = short_cutoff_options(state.X, state.topology, options, MeshParts::one());
      EXPECT_EQ(gentle.has_value(), cutoff < 2) << laplacian << " " << cutoff;
      if (gentle) {
        EXPECT_NEAR(gentle->relaxation, cutoff * cutoff / 4, 1e-12);
        EXPECT_EQ(gentle->clean_up, cutoff > 1);
      }
    }
  }
}

}  // namespace
}  // namespace ibmfair::test
