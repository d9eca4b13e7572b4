#include "ibmfair/flow/settings/risk_curve.h"

#include <algorithm>
#include <cmath>
namespace ibmfair {

std::size_t least_risk(const std::vector<CutoffTrial>& trials) {
  const auto less = [](const CutoffTrial& a, const CutoffTrial& b) {
    return a.total() < b.total();
  };
  return static_cast<std::size_t>(std::min_element(trials.begin(), trials.end(), less) -
                                  trials.begin());
}

double cutoff_of_least_risk(const std::vector<CutoffTrial>& trials, bool keeps_creases) {
  const std::size_t i = least_risk(trials);
  if (i == 0 || i + 1 == trials.size()) {
    return trials[i].cutoff;
  }
  const double left = trials[i - 1].total() - trials[i].total();
  const double right = trials[i + 1].total() - trials[i].total();
  const double shift = left + right > 0 ? (left - right) / (2 * (left + right)) : 0;
  const double kept = keeps_creases ? std::max(shift, 0.0) : shift;
  return trials[i].cutoff * std::pow(trials[i + 1].cutoff / trials[i].cutoff, kept);
}

std::vector<CutoffTrial> trials_around(const std::function<CutoffTrial(double)>& trial,
                                       const CutoffRange& range) {
  const double factor = std::sqrt(2.0);
  std::vector<CutoffTrial> trials{trial(range.start)};
  if (trials[0].total() > range.hopeless) {
    if (range.shortest < range.start) {
      trials.insert(trials.begin(), trial(range.shortest));
    }
    return trials;
  }
  const auto gains = [&] {
    const std::size_t n = trials.size();
    return n < 2 || trials[n - 1].total() < trials[n - 2].total() - range.tolerance;
  };
  for (double cutoff = factor * range.start; cutoff <= range.largest && gains(); cutoff *= factor) {
    trials.push_back(trial(cutoff));
  }
  if (trials.size() > 1 && trials[1].total() <= trials[0].total() + range.tolerance) {
    trials.erase(trials.begin(), trials.begin() + (least_risk(trials) == 0 ? 1 : 0));
    return trials;
  }
  for (double cutoff = range.start / factor; cutoff >= range.shortest && least_risk(trials) == 0;
       cutoff /= factor) {
    trials.insert(trials.begin(), trial(cutoff));
  }
  return trials;
}

}  // namespace ibmfair
