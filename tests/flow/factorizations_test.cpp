// Each factorization proves the other: the multifrontal method of this library, and CHOLMOD.
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/flow/linear_system/assembled_jacobian.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/family.h"
#include "support/flow_run.h"
#include "support/meshes.h"
#include "support/solvers.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// Options of the flow by a member of the family, with float64 asked for.
FlowOptions flow_options(const Member& member) {
  FlowOptions options;
  options.laplacian = member.laplacian;
  options.mass = member.mass != "none";
  if (options.mass) options.mass_matrix = member.mass;
  options.solver_tolerance = 1e-6;
  return options;
}

Eigen::VectorXd diagonal_of(const SymmetricMatrix& J) {
  Eigen::VectorXd diagonal(J.size());
  for (std::int64_t j = 0; j < J.size(); ++j) {
    diagonal[j] = J.value[J.column_first[j]];
  }
  return diagonal;
}

/// A linear system J Y = B, where J = D + h S has a condition of about `stiffness`: the largest
/// quotient of a diagonal entry of h S and of D.
class System {
 public:
  /// `hold` fixes every third vertex.
  System(const State& state, const Member& member, double stiffness, bool hold = false)
      : X_(shaken(state, 0.1)),
        energy_(member.create(state.topology)),
        terms_(energy_->stencils(), state.topology.vertex_count),
        unknowns_([&] {
          std::vector<std::uint8_t> fixed(state.X.rows(), 0);
          for (std::size_t v = 0; hold && v < fixed.size(); v += 3) {
            fixed[v] = 1;
          }
          return Unknowns(fixed);
        }()),
        options_(flow_options(member)) {
    energy_->linearise(X_, weights_);
    const PerVertex mass = lumped_vertex_mass(X_, state.topology);
    D = mass(unknowns_.vertex).cwiseMax(1e-6 * mass.maxCoeff());
    h_ = 1;
    const Eigen::VectorXd diagonal = diagonal_of(matrix());
    const double largest = (diagonal - D).cwiseQuotient(D).maxCoeff();
    h_ = largest > 0 ? stiffness / largest : 1;
  }

  Index size() const { return unknowns_.size(); }

  struct Outcome {
    Points Y;
    std::string failure;  ///< the message of FactorizationFailed, or empty
    FactorForecast forecast;
  };

  Outcome solve(std::string_view solver, const Points& B) const {
    FlowReport report;
    Outcome outcome;
    const auto backend = jacobian_backend(solver).make({X_, terms_, unknowns_, options_, report});
    try {
      backend->update({weights_, D, h_});
      backend->solve(B, outcome.Y);
    } catch (const FactorizationFailed& failed) {
      outcome.failure = failed.what();
    }
    outcome.forecast = report.forecast;
    return outcome;
  }

  SymmetricMatrix matrix() const {
    FlowReport report;
    AssembledJacobian J({X_, terms_, unknowns_, options_, report});
    J.update({weights_, D, h_});
    return J.matrix();
  }

  Eigen::VectorXd D;  ///< may be changed between solves

 private:
  Points X_;
  std::unique_ptr<BendingEnergy> energy_;
  StencilTerms terms_;
  Unknowns unknowns_;
  FlowOptions options_;
  StencilWeights weights_;
  double h_ = 0;
};

#define SKIP_WITHOUT_CHOLMOD() \
  if (!has_cholmod()) GTEST_SKIP() << "CHOLMOD was not built in, or is not installed"

class Factorizations : public testing::TestWithParam<Member> {};

/// |B| in the norm of D^-1, with D the diagonal of J, so that small triangles count as large ones.
double norm(const SymmetricMatrix& J, const Points& B) {
  return std::sqrt((diagonal_of(J).cwiseInverse().asDiagonal() * B.cwiseAbs2()).sum());
}

void expect_agreement(const System& system, double stiffness, const std::string& name) {
  const SymmetricMatrix J = system.matrix();
  // Of noise, which J has made large.
  const Points noise = multiply(J, random_directions(system.size()));
  const auto ours = system.solve("multifrontal", noise), cholmods = system.solve("cholmod", noise);
  ASSERT_EQ(ours.failure + cholmods.failure, "") << name;
  EXPECT_LE(norm(J, multiply(J, ours.Y - cholmods.Y)), 1e-12 * norm(J, noise)) << name;
  // Both found the same structure.
  EXPECT_EQ(ours.forecast.ordering, cholmods.forecast.ordering) << name;
  EXPECT_EQ(ours.forecast.factor_entries, cholmods.forecast.factor_entries) << name;
  EXPECT_EQ(ours.forecast.flops, cholmods.forecast.flops) << name;
  // Of a step that bending resists. Rounding J in its last digit changes the solution by as much.
  const Points step = system.D.asDiagonal() * random_directions(system.size());
  const double difference = (system.solve("multifrontal", step).Y - system.solve("cholmod", step).Y)
                                .cwiseAbs()
                                .maxCoeff();
  EXPECT_LE(difference, 8 * std::numeric_limits<double>::epsilon() * stiffness) << name;
}

TEST_P(Factorizations, AgreeToTwelveDigits) {
  SKIP_WITHOUT_CHOLMOD();
  for (const auto& [name, mesh] : at_all_scales(all_meshes())) {
    for (const double stiffness : {1e2, 1e5, 1e8}) {
      for (const bool hold : {false, true}) {
        const System system(State(mesh), GetParam(), stiffness, hold);
        expect_agreement(system, stiffness, name + ", stiffness " + std::to_string(stiffness));
      }
    }
  }
}

TEST_P(Factorizations, FailAlikeWithTheSameMessage) {
  SKIP_WITHOUT_CHOLMOD();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  for (const auto& [name, mesh] : good_meshes()) {
    const System whole(State(mesh), GetParam(), 1e3);
    const Points B = random_directions(whole.size());
    for (const double factor : {-1.0, -1e3, -1e6, nan, infinity}) {
      for (const Index unknown : {Index{0}, whole.size() / 2, whole.size() - 1}) {
        System system(State(mesh), GetParam(), 1e3);
        system.D[unknown] *= factor;
        const auto ours = system.solve("multifrontal", B), cholmods = system.solve("cholmod", B);
        EXPECT_EQ(ours.failure, cholmods.failure)
            << name << ", unknown " << unknown << " times " << factor;
        if (!std::isfinite(factor)) {
          EXPECT_TRUE(ours.failure.find(" " + std::to_string(unknown) + ":") != std::string::npos)
              << ours.failure;
        }
      }
    }
    System system(State(mesh), GetParam(), 1e3);
    system.D *= -1;
    const auto ours = system.solve("multifrontal", B), cholmods = system.solve("cholmod", B);
    EXPECT_NE(ours.failure, "") << name;
    EXPECT_EQ(ours.failure, cholmods.failure) << name;
  }
}

TEST_P(Factorizations, EndFlowsAtTheSamePositions) {
  SKIP_WITHOUT_CHOLMOD();
  for (const auto& [name, mesh] : all_meshes()) {
    State state(mesh);
    const double size = (state.X.colwise().maxCoeff() - state.X.colwise().minCoeff()).norm();
    state.X = shaken(state, 0.1);
    for (const bool guarded : {true, false}) {
      FlowOptions options = flow_options(GetParam());
      options.guarded = guarded;
      options.steps = 4;
      const auto ended = [&](const std::string& solver) -> std::optional<FlowRun> {
        options.solver = solver;
        try {
          return run_flow(state, 3, options);
        } catch (const Error&) {
          return std::nullopt;
        }
      };
      const auto ours = ended("multifrontal"), cholmods = ended("cholmod");
      ASSERT_EQ(ours.has_value(), cholmods.has_value()) << name;
      if (!ours) continue;
      EXPECT_EQ(ours->report.status, cholmods->report.status) << name;
      const double difference = (ours->X - cholmods->X).cwiseAbs().maxCoeff() / size;
      EXPECT_LE(difference, 1e-9) << name << (guarded ? "" : ", plain");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Family, Factorizations, testing::ValuesIn(family()),
                         [](const auto& info) { return identifier(info.param); });

/// Large enough for nested dissection and for supernodes of many columns.
TEST(LargeFactorizations, AgreeToTwelveDigits) {
  SKIP_WITHOUT_CHOLMOD();
  for (const auto& mesh : {make_shape("icosphere", {.subdivide = 5}),
                           make_shape("torus", {.rows = 96}), flat_sheet(120, 100)}) {
    constexpr double stiffness = 1e6;
    const System system(State(mesh), {"crouzeix-raviart", "crouzeix-raviart"}, stiffness);
    EXPECT_GT(system.size(), 6000);
    expect_agreement(system, stiffness, "");
  }
}

}  // namespace
}  // namespace ibmfair::test
