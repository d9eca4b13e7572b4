// The checks for folds find every fold.
#include "ibmfair/flow/steps/folds.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

// The flow asks the energy for possible folds before it checks the hinges. The energy must never
// overlook a fold, and it must seldom raise a false alarm; otherwise the question is of no use.
TEST(Folds, AreNeverRuledOutWhereThereAreAnyAndMostlyWhereThereAreNone) {
  for (const double angle : {fold_angle, tuning.clean_up.fold}) {
    int folded = 0, ruled_out = 0, in_doubt = 0;
    for (const auto& [name, mesh] : good_meshes()) {
      const State state(mesh);
      const auto energy = bending_model("crouzeix-raviart").create(state.topology, {});
      for (const double amount : {0.1, 0.3, 0.5, 1.0}) {
        for (unsigned seed = 1; seed <= 20; ++seed) {
          const Points X = shaken(state, amount, seed);
          const std::vector<std::uint8_t> folds = folded_hinges(X, state.topology, angle);
          const bool any = std::find(folds.begin(), folds.end(), 1) != folds.end();
          energy->energy(X);
          const bool none = energy->max_dihedral_turn() < least_turn(angle);
          EXPECT_FALSE(any && none) << name;
          folded += any ? 1 : 0;
          ruled_out += none ? 1 : 0;
          in_doubt += !any && !none ? 1 : 0;
        }
      }
    }
    EXPECT_GT(folded, 100) << angle;
    EXPECT_GT(ruled_out, 100) << angle;
    EXPECT_LT(in_doubt, (folded + ruled_out) / 50) << angle;
  }
}

// The watch for folds may look only at the places where the energy has seen large turns: it still
// sees all folds.
TEST(Folds, AreSeenWhereTheEnergyHasSeenTurns) {
  const State state(make_shape("icosphere", {.subdivide = 5}));
  const auto energy = bending_model("crouzeix-raviart").create(state.topology, {});
  const FoldWatch folds(state.X, state.topology);
  const double edge = mean_edge_length(state.X, state.topology.E);
  std::mt19937 random(3);
  std::uniform_int_distribution<Index> any(0, static_cast<Index>(state.X.rows()) - 1);
  for (const int moved : {0, 1, 3, 10}) {
    Points X = state.X;
    for (int i = 0; i < moved; ++i) {
      auto x = X.row(any(random));  // this vertex slides over its neighbours
      x += 2.5 * edge * x.cross(Vec3(0.36, 0.48, 0.8)).normalized();
    }
    energy->energy(X);
    const std::vector<std::uint8_t> near = energy->near_turns(least_turn());
    const std::vector<Index> expected = folds.new_folds(X);
    EXPECT_EQ(folds.new_folds(X, near), expected);
    EXPECT_EQ(expected.empty(), moved == 0);
    EXPECT_GT(std::count(near.begin(), near.end(), 0), moved == 10 ? 0 : state.X.rows() / 4);
  }
}

}  // namespace
}  // namespace ibmfair::test
