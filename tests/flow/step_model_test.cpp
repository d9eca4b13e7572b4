// The Gauss-Newton model of a step: exact for quadratic energies, and right to first order for all.
#include "ibmfair/flow/steps/step_model.h"

#include <gtest/gtest.h>

#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/mesh/geometry.h"
#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// A problem in the middle of its flow, with a Newton step from there. Boundaries stay: the steps
/// of free ones are cut to a part, for which no model is exact.
struct Midway {
  Midway(const State& of, const Member& member)
      : state(of), fixed(fixed_vertices(of.topology, BoundaryCondition::position)) {
    state.X = shaken(of, 0.1);
    options.laplacian = member.laplacian;
    options.mass = member.mass != "none";
    if (options.mass) options.mass_matrix = member.mass;
    options.solver = "multifrontal";
    options.solver_tolerance = 1e-8;
    const double time = time_for_cutoff(4 * mean_edge_length(state.X, state.topology.E));
    options.total_time = time_in_flow_units(time, state.X, state.topology, options);
    problem.emplace(state.X, state.topology, fixed, options, MeshParts::one());
    problem->update_gradient();
    problem->jacobian().refactor(state.X, options.total_time);
    problem->newton_step(step);
  }

  double actual_decrease(double a) {
    Points Y = state.X;
    Y(problem->unknowns.vertex, Eigen::all) += a * step;
    return problem->energy() - problem->energy_at(Y);
  }

  State state;
  std::vector<std::uint8_t> fixed;
  FlowOptions options;
  std::optional<FlowProblem> problem;
  Points step;
};

class StepModels : public testing::TestWithParam<Member> {};

TEST_P(StepModels, PredictTheDecreaseToFirstOrder) {
  for (const auto& [name, mesh] : closed_meshes()) {
    Midway midway(State(mesh), GetParam());
    const StepModel model(*midway.problem, midway.step);
    double last = 0;
    for (const double a : {1e-3, 1e-4}) {
      EXPECT_GT(model.decrease(a), 0) << name;
      const double error = std::abs(midway.actual_decrease(a) / model.decrease(a) - 1);
      EXPECT_LT(error, 0.1) << name << " " << a;
      if (last > 1e-6) {
        EXPECT_LT(error, last / 5) << name;
      }
      last = error;
    }
  }
}

TEST(StepModel, IsExactForAQuadraticEnergy) {
  for (const auto& [name, mesh] : good_meshes()) {
    Midway midway(State(mesh), {"umbrella", "none"});
    const StepModel model(*midway.problem, midway.step);
    for (const double a : {0.1, 0.5, 1.0}) {
      EXPECT_NEAR(model.decrease(a), midway.actual_decrease(a), 1e-10 * midway.problem->energy())
          << name << " " << a;
    }
  }
}

TEST(StepModel, PredictsNoMoreThanAllOfTheEnergy) {
  Midway midway(State(closed_meshes()[3].mesh), {"lagrange", "barycentric"});
  const StepModel model(*midway.problem, 1e3 * midway.step);
  EXPECT_EQ(model.decrease(1), midway.problem->energy());
}

INSTANTIATE_TEST_SUITE_P(Family, StepModels, testing::ValuesIn(family()),
                         [](const auto& info) { return identifier(info.param); });

}  // namespace
}  // namespace ibmfair::test
