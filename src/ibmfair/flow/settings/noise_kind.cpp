#include "ibmfair/flow/settings/noise_kind.h"

#include <algorithm>
#include <cstddef>

#include "ibmfair/flow/settings/choice_tuning.h"

namespace ibmfair {
namespace {

constexpr std::size_t first_bands = 3, last_band = 4;

bool is_noise(const NoiseBand& band) {
  return band.by_rms >= choice_tuning.noise.least && band.evenness >= choice_tuning.noise.even &&
         band.by_rms >= choice_tuning.noise.tails * band.by_median &&
         band.by_rms <= choice_tuning.noise.long_tails * band.by_median;
}

}  // namespace

const char* name_of(NoiseKind kind) {
  switch (kind) {
    case NoiseKind::none:
      return "none";
    case NoiseKind::outliers:
      return "outliers";
    case NoiseKind::correlated:
      return "correlated";
    case NoiseKind::steps:
      return "steps";
    case NoiseKind::independent:
      break;
  }
  return "independent";
}

BandRange bands_of_correlated_noise(const std::vector<NoiseBand>& bands) {
  if (bands.size() < first_bands) {
    return {};
  }
  const auto first = bands.begin();
  if (std::all_of(first, first + first_bands, is_noise)) {
    const bool grows =
        bands[first_bands - 1].by_median > choice_tuning.noise.growth * bands[0].by_median;
    return grows ? BandRange{0, first_bands} : BandRange{};
  }
  const std::size_t end = std::min(bands.size(), last_band);
  for (std::size_t i = 2; i < end && !is_noise(bands[0]); ++i) {
    const double before = bands[i - 1].by_median;
    if (is_noise(bands[i - 1]) && is_noise(bands[i]) &&
        before > choice_tuning.noise.growth * bands[0].by_median &&
        bands[i].by_median > choice_tuning.noise.later_growth * before) {
      return {i - 1, i + 1};
    }
  }
  return {};
}

bool is_white(const std::vector<NoiseBand>& bands) {
  return bands.size() >= 2 &&
         std::min(bands[0].evenness, bands[1].evenness) >= choice_tuning.noise.white_even &&
         bands[1].by_median <= choice_tuning.noise.white_growth * bands[0].by_median;
}

bool may_tell_more(const std::vector<NoiseBand>& bands) {
  if (!bands.empty() && !is_noise(bands[0])) {
    return bands.size() < last_band && bands_of_correlated_noise(bands).empty();
  }
  return bands.size() < first_bands && std::all_of(bands.begin(), bands.end(), is_noise);
}

}  // namespace ibmfair
