// The line search goes along a Newton step as far as the energy decreases enough, and slows down
// the few vertices that raise the energy.
#include "ibmfair/flow/steps/line_search.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// A rough mesh with a Newton step that takes it to a cut-off of a few edges.
class Searching {
 public:
  explicit Searching(const State& of, double roughness = 0.05, FlowOptions with = {})
      : state_(of), options_(std::move(with)) {
    state_.X = shaken(of, roughness);
    options_.solver = "multifrontal";
    options_.total_time = time_for_cutoff(4 * mean_edge_length(state_.X, state_.topology.E));
    problem.emplace(state_.X, state_.topology, fixed_, options_, MeshParts::one());
    folds.emplace(state_.X, state_.topology);
    damping.emplace(*problem);
    search.emplace(*problem, *folds, *damping);
    problem->update_gradient();
    problem->jacobian().refactor(state_.X, options_.total_time);
    problem->newton_step(step);
    damping->begin_step();
  }

  bool find() { return search->find(step, StepModel(*problem, step), 1, true); }

 private:
  State state_;
  FlowOptions options_;
  const std::vector<std::uint8_t> fixed_ = std::vector<std::uint8_t>(state_.X.rows(), 0);

 public:
  std::optional<FlowProblem> problem;
  std::optional<FoldWatch> folds;
  std::optional<LocalDamping> damping;
  std::optional<LineSearch> search;
  Points step;
};

TEST(LineSearch, TakesAllOfAGoodStep) {
  for (const auto& [name, mesh] : closed_meshes()) {
    Searching at{State(mesh)};
    const Points before = at.problem->X;
    ASSERT_TRUE(at.find()) << name;
    const LineSearch::Result& found = at.search->result();
    EXPECT_GE(found.decrease_ratio, tuning.guard.least_decrease) << name;
    EXPECT_LT(found.energy, at.problem->energy()) << name;
    EXPECT_EQ(at.problem->energy_at(before + found.move), found.energy) << name;
    if (found.held_back == 0) {
      EXPECT_EQ(found.move, found.fraction * at.step) << name;
    }
    at.search->move_to_result();
    EXPECT_EQ(at.problem->X, before + found.move) << name;
  }
}

TEST(LineSearch, HalvesAStepThatIsTooLong) {
  Searching at(State(make_shape("torus", {.ratio = 2.5, .rows = 24, .columns = 60})));
  const double longest = at.problem->longest(at.step);
  at.step *= 3;  // twice as far as where the model ends
  ASSERT_TRUE(at.find());
  EXPECT_LT(at.search->result().fraction, 1);
  EXPECT_GT(at.problem->report.rejected, 0);
  EXPECT_LT(at.problem->longest(at.search->result().move), 3 * longest);
}

TEST(LineSearch, FindsNothingUphill) {
  Searching at(State(make_shape("icosphere", {.subdivide = 3})));
  const Points before = at.problem->X;
  const StepModel model(*at.problem, at.step);
  EXPECT_FALSE(at.search->find(-at.step, model, 1, true));
  EXPECT_EQ(at.problem->report.rejected, tuning.guard.most_halvings + 1);
  EXPECT_EQ(at.problem->X, before);
}

TEST(LineSearch, SlowsDownTheFewVerticesThatRaiseTheEnergy) {
  for (const char* laplacian : {"crouzeix-raviart", "lagrange"}) {
    FlowOptions options;
    options.laplacian = laplacian;
    Searching at(State(make_shape("torus", {.ratio = 2.5, .rows = 40, .columns = 100})), 0.01,
                 options);
    const StepModel model(*at.problem, at.step);
    const Index bad = 500;
    const double edge = mean_edge_length(at.problem->X, at.problem->topology.E);
    at.step.row(bad) = 2 * edge * at.problem->gradient().row(bad).normalized();
    ASSERT_TRUE(at.search->find(at.step, model, 1, true)) << laplacian;
    const LineSearch::Result& found = at.search->result();
    EXPECT_EQ(found.fraction, 1) << laplacian;
    EXPECT_GT(found.held_back, 0) << laplacian;
    EXPECT_LT(found.move.row(bad).norm(), 0.5 * at.step.row(bad).norm()) << laplacian;
    EXPECT_EQ(found.move.row(3000), at.step.row(3000)) << laplacian;
    EXPECT_TRUE(at.damping->is_active()) << laplacian;
  }
}

}  // namespace
}  // namespace ibmfair::test
