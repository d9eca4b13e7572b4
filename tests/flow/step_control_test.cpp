// The control of time steps: they end at the total time, are cut where a step fails, and grow back.
#include "ibmfair/flow/steps/step_control.h"

#include <limits>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

constexpr double total = 3;
constexpr int steps = 16;

class StepControlTest : public testing::Test {
 protected:
  /// Makes a part of the next step, with this decrease of the energy over the predicted one.
  void make(double decrease, bool damped = false, double distortion = 0, double part = 1) {
    const double h = control_.time_step();
    StepRecord made;
    made.time_step = std::min(part * h, control_.left());
    made.decrease_ratio = decrease;
    made.refactored = control_.is_stale();
    if (made.refactored) control_.jacobian_was_renewed();
    control_.advance(made.time_step);
    control_.adapt(made, h, distortion, damped, [](double, double longest) { return longest; });
  }

  StepControl control_{{.steps = steps, .total_time = total}};
};

TEST_F(StepControlTest, GoodStepsTakeTheirNumberAndOneJacobian) {
  int made = 0;
  for (; !control_.has_ended(); ++made) {
    EXPECT_EQ(control_.is_stale(), made == 0);
    EXPECT_DOUBLE_EQ(control_.time_step(), total / steps);
    make(0.99);
  }
  EXPECT_EQ(made, steps);
  EXPECT_NEAR(control_.reached(), total, 1e-9 * total);
}

TEST_F(StepControlTest, AFailureRenewsTheJacobianFirstAndThenCutsTheStep) {
  make(0.9);
  const double h = control_.time_step();
  control_.give_up(false);
  EXPECT_TRUE(control_.is_stale());
  EXPECT_EQ(control_.time_step(), h);
  control_.jacobian_was_renewed();
  control_.give_up(true);
  EXPECT_LT(control_.time_step(), h / 10);
  // It grows back to the target, faster where the step distorts little.
  int slow = 0, fast = 0;
  StepControl cut = control_;
  for (; control_.time_step() < control_.target(); ++fast) {
    make(0.9);
  }
  control_ = cut;
  for (; control_.time_step() < control_.target(); ++slow) {
    make(0.9, false, 0.8);
  }
  EXPECT_GT(slow, fast);
  EXPECT_GT(fast, 0);
  EXPECT_EQ(control_.time_step(), control_.target());
}

TEST_F(StepControlTest, ShortenedStepsRenewTheJacobianAndShortenStepsOfANewOne) {
  make(0.3, false, 0, 0.5);  // by a new Jacobian
  EXPECT_TRUE(control_.is_stale());
  EXPECT_EQ(control_.time_step(), total / steps / 2);
  make(0.3, false, 0, 0.5);
  EXPECT_EQ(control_.time_step(), total / steps / 4);
}

TEST_F(StepControlTest, FailsAfterManySolves) {
  EXPECT_FALSE(control_.has_failed(5 * steps));
  EXPECT_TRUE(control_.has_failed(1000 * steps));
  const StepControl patch({.steps = steps, .total_time = total, .clean_up = false});
  EXPECT_FALSE(patch.has_failed(2 * steps));
  EXPECT_TRUE(patch.has_failed(6 * steps));
}

TEST_F(StepControlTest, ANumberThatIsNoneNeverMakesStepsLonger) {
  control_.give_up(true);
  const double h = control_.time_step();
  make(std::numeric_limits<double>::quiet_NaN());
  EXPECT_LE(control_.time_step(), h);
}

TEST_F(StepControlTest, DampedRegionsGetANewJacobianNowAndThen) {
  int since = 0;
  for (make(0.9, true); !control_.is_stale() && since < 100; ++since) {
    make(0.9, true);
  }
  EXPECT_GT(since, 0);
  EXPECT_LT(since, 10);
}

TEST_F(StepControlTest, FailsAfterFiniteCuts) {
  int cuts = 0;
  while (!control_.has_failed() && cuts < 1000) {
    const bool last = control_.is_at_last_cut();
    control_.give_up(true);
    EXPECT_EQ(control_.has_failed(), last);
    ++cuts;
  }
  EXPECT_LT(cuts, 20);
  EXPECT_EQ(control_.left(), total) << "no time passed";
}

TEST_F(StepControlTest, EndsAtAStationaryState) {
  make(0.9);
  control_.end();
  EXPECT_TRUE(control_.has_ended());
  EXPECT_EQ(control_.reached(), total);
}

}  // namespace
}  // namespace ibmfair::test
