#include "ibmfair/flow/settings/noise_kind.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ibmfair/flow/settings/choice_tuning.h"

namespace ibmfair {
namespace {

constexpr std::size_t first_bands = 3, last_band = 4, last_mixed_band = 5;

bool is_noise(const NoiseBand& band) {
  return band.by_rms >= choice_tuning.noise.least && band.evenness >= choice_tuning.noise.even &&
         band.by_rms >= choice_tuning.noise.tails * band.by_median &&
         band.by_rms <= choice_tuning.noise.long_tails * band.by_median;
}

/// Whether the first three bands are of noise.
bool are_noise(const std::vector<NoiseBand>& bands) {
  return bands.size() >= first_bands &&
         std::all_of(bands.begin(), bands.begin() + first_bands, is_noise);
}

bool grows_clearly(const std::vector<NoiseBand>& bands) {
  return are_noise(bands) &&
         bands[first_bands - 1].by_median > choice_tuning.noise.growth * bands[0].by_median;
}

/// `first`: the first band. Both are of noise.
bool is_more_than_white(const NoiseBand& band, const NoiseBand& first) {
  return band.by_median > choice_tuning.noise.mixed_growth * first.by_median;
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
  if (are_noise(bands)) {
    return grows_clearly(bands) ? BandRange{0, first_bands} : BandRange{};
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

BandRange bands_of_mixed_noise(const std::vector<NoiseBand>& bands) {
  if (bands.size() <= first_bands) {
    return {};
  }
  if (grows_clearly(bands)) {
    return is_noise(bands[first_bands]) ? BandRange{0, first_bands + 1} : BandRange{};
  }
  const auto longer =
      std::find_if(bands.begin() + first_bands, bands.end(),
                   [&](const NoiseBand& band) { return is_more_than_white(band, bands[0]); });
  if (longer == bands.end() || !std::all_of(bands.begin(), longer + 1, is_noise)) {
    return {};
  }
  const double white = std::pow(bands[0].by_rms, 2), all = std::pow(longer->by_rms, 2);
  const double quartile = longer->evenness * all - choice_tuning.noise.evenness_of_white * white;
  return quartile >= choice_tuning.noise.even_rest * (all - white)
             ? BandRange{0, static_cast<std::size_t>(longer - bands.begin()) + 1}
             : BandRange{};
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
  return bands.size() < (grows_clearly(bands) ? first_bands + 1 : last_mixed_band) &&
         std::all_of(bands.begin(), bands.end(), is_noise) &&
         !(bands.size() > first_bands && is_more_than_white(bands.back(), bands[0]));
}

}  // namespace ibmfair
