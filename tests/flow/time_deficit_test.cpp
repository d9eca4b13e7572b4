// The time deficit of an unknown is the flow time that it misses when a flow slows it down. It adds
// up over the steps and is forgotten as time goes by.
#include "ibmfair/flow/steps/time_deficit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

constexpr double memory = 4;

TEST(TimeDeficit, IsWhatAnUnknownMissesOfAStep) {
  TimeDeficit deficit(5, memory);
  Eigen::VectorXd damping = Eigen::VectorXd::Ones(5);
  damping[1] = damping[4] = 1e12;
  deficit.slow(2, 0);
  deficit.slow(3, 0.5);
  deficit.slow(3, 0.5);
  deficit.end_step(1, damping, {4});
  EXPECT_EQ(deficit.missed()[0], 0);
  EXPECT_NEAR(deficit.missed()[1], 1, 1e-9) << "damped";
  EXPECT_EQ(deficit.missed()[2], 1) << "slowed down on the way";
  EXPECT_NEAR(deficit.missed()[3], 0.75 * std::exp(-0.25 / memory), 1e-15)
      << "twice, to a half each";
  EXPECT_EQ(deficit.missed()[4], 0) << "went as far as it may";
}

TEST(TimeDeficit, AddsUpAndIsForgottenAsTimeGoesBy) {
  for (const double time_step : {1.0, 0.125}) {
    TimeDeficit deficit(1, memory);
    for (double time = 0; time < 8; time += time_step) {
      deficit.slow(0, 0);
      deficit.end_step(time_step, Eigen::VectorXd::Ones(1), {});
    }
    EXPECT_EQ(deficit.missed()[0], 8);
    for (double time = 0; time < memory; time += time_step) {
      deficit.end_step(time_step, Eigen::VectorXd::Ones(1), {});
    }
    EXPECT_NEAR(deficit.missed()[0], 8 / std::numbers::e, 1e-12);
  }
}

TEST(TimeDeficit, KnowsNothingOfAStepThatIsNotMade) {
  TimeDeficit deficit(1, memory);
  deficit.slow(0, 0);
  deficit.forget_step();
  deficit.end_step(1, Eigen::VectorXd::Ones(1), {});
  EXPECT_EQ(deficit.missed()[0], 0);
}

}  // namespace
}  // namespace ibmfair::test
