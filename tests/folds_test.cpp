#include "ibmfair/flow/folds.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/unfolding.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

// The energy is asked before the hinges are: it must never overlook a fold, and seldom raise a
// false alarm, or asking is no use.
TEST(Folds, AreNeverRuledOutWhereThereAreAnyAndMostlyWhereThereAreNone) {
  for (const double angle : {fold_angle, fold_to_undo}) {
    int folded = 0, ruled_out = 0, in_doubt = 0;
    for (const auto& [name, mesh] : good_meshes()) {
      const State state(mesh);
      const auto energy = bending_model("crouzeix-raviart").bind(state.topology, {});
      for (const double amount : {0.1, 0.3, 0.5, 1.0}) {
        for (unsigned seed = 1; seed <= 20; ++seed) {
          const Points X = shaken(state, amount, seed);
          const std::vector<std::uint8_t> folds = folded_hinges(X, state.topology, angle);
          const bool any = std::find(folds.begin(), folds.end(), 1) != folds.end();
          energy->energy(X);
          const bool none = rules_out_folds(energy->largest_turn(), angle);
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

}  // namespace
}  // namespace ibmfair::test
