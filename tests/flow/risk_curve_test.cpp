// Risks over the cut-off: which cut-offs are tried, and which one is taken.
#include "ibmfair/flow/settings/risk_curve.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ibmfair::test {
namespace {

/// A parabola over the logarithm of the cut-off.
CutoffTrial parabola(double cutoff, double best) {
  return {cutoff, 0.1 + std::pow(std::log(cutoff / best), 2)};
}

TEST(RiskCurve, TrialsBracketTheLeastRiskWhereverTheyStart) {
  for (const double best : {2.5, 4.0, 7.3, 15.0}) {
    for (const double start : {3.0, 6.0, 12.0}) {
      const auto trials = trials_around([&](double cutoff) { return parabola(cutoff, best); },
                                        {.start = start, .shortest = 1, .largest = 40});
      const std::size_t least = least_risk(trials);
      ASSERT_GT(least, 0) << best << " from " << start;
      ASSERT_LT(least + 1, trials.size());
      for (std::size_t i = 1; i < trials.size(); ++i) {
        EXPECT_NEAR(trials[i].cutoff / trials[i - 1].cutoff, std::sqrt(2.0), 1e-12);
      }
      EXPECT_NEAR(cutoff_of_least_risk(trials, false), best, 1e-9 * best);
    }
  }
}

TEST(RiskCurve, TrialsStayInTheRangeAndGoNoFurtherWhereThatIsHopeless) {
  int calls = 0;
  const auto falling = [&](double cutoff) {
    ++calls;
    return CutoffTrial{cutoff, 1 / cutoff};
  };
  const auto up = trials_around(falling, {.start = 4, .shortest = 2, .largest = 9});
  EXPECT_EQ(up.size(), 3U);
  EXPECT_EQ(calls, 3);
  const auto hopeless =
      trials_around(falling, {.start = 4, .shortest = 2, .largest = 9, .hopeless = 0.2});
  ASSERT_EQ(hopeless.size(), 2U);
  EXPECT_EQ(hopeless.front().cutoff, 2);
  EXPECT_EQ(hopeless.back().cutoff, 4);
  const auto rising = [](double cutoff) { return CutoffTrial{cutoff, cutoff}; };
  EXPECT_GE(trials_around(rising, {.start = 4, .shortest = 2, .largest = 9}).front().cutoff, 2);
}

TEST(RiskCurve, OfTheFirstTwoTheLongerOneIsTakenIfBothLeaveTheSame) {
  const auto flat = [](double cutoff) {
    return CutoffTrial{cutoff, cutoff < 6 ? 0.1 : 0.1005 + 0.01 * (cutoff - 6)};
  };
  const auto equal =
      trials_around(flat, {.start = 4.5, .shortest = 1, .largest = 40, .tolerance = 0.01});
  EXPECT_NEAR(cutoff_of_least_risk(equal, true), 4.5 * std::sqrt(2.0), 1e-12);
  const auto less = trials_around(flat, {.start = 4.5, .shortest = 1, .largest = 40});
  EXPECT_LT(cutoff_of_least_risk(less, true), 5);
}

TEST(RiskCurve, CreasesDoNotShortenTheCutoff) {
  const std::vector<CutoffTrial> trials{{2, 1.1}, {4, 1}, {8, 2}};
  EXPECT_LT(cutoff_of_least_risk(trials, false), 4);
  EXPECT_EQ(cutoff_of_least_risk(trials, true), 4);
}

TEST(RiskCurve, TheCutoffAtAnEndOfTheTrialsIsThatOfTheTrial) {
  EXPECT_EQ(cutoff_of_least_risk({{2, 1}, {3, 2}}, false), 2);
  EXPECT_EQ(cutoff_of_least_risk({{2, 2}, {3, 1}}, true), 3);
  EXPECT_EQ(cutoff_of_least_risk({{2, 0}}, false), 2);
}

}  // namespace
}  // namespace ibmfair::test
