// Damping makes the metric heavier around uphill vertices when the Jacobian is renewed, and fades
// where they raise the energy no more.
#include "ibmfair/flow/steps/local_damping.h"

#include <gtest/gtest.h>

#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/shapes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// A move of a torus that is downhill everywhere but at one vertex.
class LocalDampings : public testing::Test {
 protected:
  static constexpr Index uphill = 700;

  LocalDampings() {
    problem_.update_gradient();
    damping_.begin_step();
  }

  /// Tries a move that raises the energy at the one vertex, and slows it down.
  bool slow(bool fresh = true) {
    Points Y = state_.X;
    Y.row(uphill) += edge_ * Vec3(0.9, 0.4, 0.3).transpose();
    const Points gradient = problem_.gradient_at(Y);
    move_ = Points::Zero(gradient.rows(), 3);
    move_.row(uphill) = gradient.row(uphill).normalized();
    whole_ = move_;
    shortened_ = 0;
    return damping_.slow(Y, fresh, move_, shortened_);
  }

  const State state_{make_shape("torus", {.ratio = 2.5, .rows = 24, .columns = 60})};
  const double edge_ = mean_edge_length(state_.X, state_.topology.E);
  const std::vector<std::uint8_t> fixed_ = std::vector<std::uint8_t>(state_.X.rows(), 0);
  const std::vector<std::uint8_t> near_ = around(state_.topology, {uphill}, 1);
  const FlowOptions options_{.total_time = 1};
  FlowProblem problem_{state_.X, state_.topology, fixed_, options_, MeshParts::one()};
  LocalDamping damping_{problem_};
  Points move_, whole_;
  std::int64_t shortened_ = 0;
};

TEST_F(LocalDampings, ShortenTheMoveAroundUphillVertices) {
  EXPECT_FALSE(damping_.is_active());
  ASSERT_TRUE(slow());
  EXPECT_TRUE(damping_.is_active());
  EXPECT_TRUE(damping_.failed_locally());
  EXPECT_EQ(shortened_, std::ranges::count(near_, 1));
  EXPECT_EQ(move_, tuning.damping.slower * whole_);
  damping_.begin_step();
  EXPECT_FALSE(damping_.failed_locally());
}

TEST_F(LocalDampings, GrowAndFadeWithTheJacobians) {
  ASSERT_TRUE(slow());
  damping_.damp();
  const Eigen::VectorXd& factors = problem_.jacobian().damping();
  for (Index u = 0; u < factors.size(); ++u) {
    EXPECT_EQ(factors[u], near_[u] ? tuning.damping.heavier : 1) << u;
  }
  double last = factors[uphill];
  int renewals = 0;
  for (; damping_.is_active() && renewals < 100; ++renewals) {
    damping_.damp();
    EXPECT_LT(factors[uphill], last);
    last = factors[uphill];
  }
  EXPECT_EQ(renewals, 4) << "256 fades by factors of 4";
  EXPECT_TRUE((factors.array() == 1).all());
}

TEST_F(LocalDampings, MissTheTimeByWhichVerticesAreSlowed) {
  ASSERT_TRUE(slow());
  damping_.end_step(0.01);
  const Eigen::VectorXd& missed = damping_.missed();
  for (Index u = 0; u < missed.size(); ++u) {
    EXPECT_EQ(missed[u] > 0, near_[u] != 0) << u;
    EXPECT_LT(missed[u], 0.01);
  }
}

TEST_F(LocalDampings, LeaveAMoveAloneThatIsUphillInManyPlaces) {
  const Points Y = shaken(state_, 0.3);
  move_ = whole_ = problem_.gradient_at(Y);
  EXPECT_FALSE(damping_.slow(Y, true, move_, shortened_));
  EXPECT_FALSE(damping_.failed_locally());
  EXPECT_EQ(move_, whole_);
  EXPECT_EQ(shortened_, 0);
}

}  // namespace
}  // namespace ibmfair::test
