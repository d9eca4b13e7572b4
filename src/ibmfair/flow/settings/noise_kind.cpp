#include "ibmfair/flow/settings/noise_kind.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
namespace {

constexpr std::size_t first_bands = 3;

bool is_noise(const NoiseBand& band) {
  return band.by_rms >= tuning.noise.least && band.evenness >= tuning.noise.even &&
         band.by_rms >= tuning.noise.tails * band.by_median &&
         band.by_rms <= tuning.noise.long_tails * band.by_median;
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

bool is_correlated(const std::vector<NoiseBand>& bands) {
  return bands.size() >= first_bands &&
         std::all_of(bands.begin(), bands.begin() + first_bands, is_noise) &&
         bands[first_bands - 1].by_median > tuning.noise.growth * bands[0].by_median;
}

bool is_white(const std::vector<NoiseBand>& bands) {
  return bands.size() >= 2 &&
         std::min(bands[0].evenness, bands[1].evenness) >= tuning.noise.white_even &&
         bands[1].by_median <= tuning.noise.white_growth * bands[0].by_median;
}

bool may_tell_more(const std::vector<NoiseBand>& bands) {
  return bands.size() < first_bands
             ? std::all_of(bands.begin(), bands.end(), is_noise)
             : is_correlated(bands) && bands.back().evenness >= tuning.noise.still_even;
}

double cutoff_of_noise(const std::vector<NoiseBand>& bands) {
  const auto end = std::find_if(bands.begin(), bands.end(), [](const NoiseBand& band) {
    return !(band.evenness >= tuning.noise.still_even);
  });
  if (end == bands.begin() || end == bands.end()) {
    return end == bands.end() ? bands.back().cutoff : bands.front().cutoff;
  }
  const NoiseBand &even = *(end - 1), &uneven = *end;
  const double share =
      (even.evenness - tuning.noise.still_even) / (even.evenness - uneven.evenness);
  return even.cutoff * std::pow(uneven.cutoff / even.cutoff, share);
}

}  // namespace ibmfair
