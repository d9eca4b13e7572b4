// The laws of the flow hold with every member of the family of energies.
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/noise.h"
#include "support/family.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

class FamilyFlows : public testing::TestWithParam<Member> {};

INSTANTIATE_TEST_SUITE_P(Family, FamilyFlows, testing::ValuesIn(family()),
                         [](const auto& tested) { return identifier(tested.param); });

TEST_P(FamilyFlows, LowerTheEnergyOfANoisyMeshAtEveryStep) {
  for (const bool closed : {true, false}) {
    SCOPED_TRACE(closed ? "torus" : "cylinder");
    TriangleMesh mesh = closed ? make_torus(2, {16, 32}) : make_cylinder(1, {10, 32});
    const Topology topology = build_topology(mesh.X, mesh.F);
    const double edge = mean_edge_length(mesh.X, topology.E);
    add_noise(mesh.X, 0.15 * edge, 3);
    FlowOptions options;
    options.laplacian = GetParam().laplacian;
    options.mass_matrix = GetParam().mass;
    options.steps = 4;
    options.total_time = time_in_flow_units(time_for_cutoff(6 * edge), mesh.X, topology, options);
    Points X = mesh.X;
    const FlowReport report =
        willmore_flow(X, topology, fixed_vertices(topology, BoundaryCondition::fixed), options);
    EXPECT_EQ(report.status, FlowStatus::completed);
    EXPECT_LT(report.energy_after, 0.5 * report.energy_before);
    double last = report.energy_before;
    for (const StepRecord& step : report.steps) {
      EXPECT_LE(step.energy, last);
      last = step.energy;
    }
    EXPECT_TRUE(X.allFinite());
  }
}

TEST(FamilyFlow, RefusesAMassThatDoesNotGoWithTheLaplacian) {
  FlowOptions options;
  options.total_time = 1;
  options.laplacian = "umbrella";
  options.mass_matrix = "voronoi";
  EXPECT_THROW(options.validate(), BadOption);
}

}  // namespace
}  // namespace ibmfair::test
