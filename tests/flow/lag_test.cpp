// The lag of an unknown is the flow time that it misses when a flow slows it down. The lag adds up
// over the steps and is forgotten as time goes by.
#include "ibmfair/flow/lag.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

constexpr double memory = 4;

TEST(Lag, IsWhatAnUnknownMissesOfAStep) {
  Lag lag(5, memory);
  Eigen::VectorXd damping = Eigen::VectorXd::Ones(5);
  damping[1] = damping[4] = 1e12;
  lag.slow(2, 0);
  lag.slow(3, 0.5);
  lag.slow(3, 0.5);
  lag.end_step(1, damping, {4});
  EXPECT_EQ(lag.missed()[0], 0);
  EXPECT_NEAR(lag.missed()[1], 1, 1e-9) << "damped";
  EXPECT_EQ(lag.missed()[2], 1) << "slowed down on the way";
  EXPECT_NEAR(lag.missed()[3], 0.75 * std::exp(-0.25 / memory), 1e-15) << "twice, to a half each";
  EXPECT_EQ(lag.missed()[4], 0) << "went as far as it may";
}

TEST(Lag, AddsUpAndIsForgottenAsTimeGoesBy) {
  for (const double time_step : {1.0, 0.125}) {
    Lag lag(1, memory);
    for (double time = 0; time < 8; time += time_step) {
      lag.slow(0, 0);
      lag.end_step(time_step, Eigen::VectorXd::Ones(1), {});
    }
    EXPECT_EQ(lag.missed()[0], 8);
    for (double time = 0; time < memory; time += time_step) {
      lag.end_step(time_step, Eigen::VectorXd::Ones(1), {});
    }
    EXPECT_NEAR(lag.missed()[0], 8 / std::numbers::e, 1e-12);
  }
}

TEST(Lag, KnowsNothingOfAStepThatIsNotMade) {
  Lag lag(1, memory);
  lag.slow(0, 0);
  lag.forget_step();
  lag.end_step(1, Eigen::VectorXd::Ones(1), {});
  EXPECT_EQ(lag.missed()[0], 0);
}

}  // namespace
}  // namespace ibmfair::test
