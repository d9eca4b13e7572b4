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
         band.evenness <= choice_tuning.noise.too_even &&
         band.by_rms >= choice_tuning.noise.tails * band.by_median &&
         band.by_rms <= choice_tuning.noise.long_tails * band.by_median;
}

/// Whether the first three bands are of noise.
bool are_noise(const std::vector<NoiseBand>& bands) {
  return bands.size() >= first_bands &&
         std::all_of(bands.begin(), bands.begin() + first_bands, is_noise);
}

/// Whether the first three bands are of noise, and the third has clearly more than the first.
bool grows_at_first(const std::vector<NoiseBand>& bands) {
  return are_noise(bands) &&
         bands[first_bands - 1].by_median > choice_tuning.noise.growth * bands[0].by_median;
}

/// The first band after the first three that has clearly more than white noise of the strength of
/// the first band; the end if none has.
std::size_t first_longer_band(const std::vector<NoiseBand>& bands) {
  std::size_t i = std::min(bands.size(), first_bands);
  while (i < bands.size() &&
         !(bands[i].by_median > choice_tuning.noise.mixed_growth * bands[0].by_median)) {
    ++i;
  }
  return i;
}

using Figure = double NoiseBand::*;  // by_rms or by_median

/// The growth from the band before band i of what is there beyond that white noise.
double growth_of_rest(const std::vector<NoiseBand>& bands, std::size_t i, Figure figure) {
  const auto rest = [&](const NoiseBand& band) {
    return std::sqrt(std::max(std::pow(band.*figure, 2) - std::pow(bands[0].*figure, 2), 0.0));
  };
  return rest(bands[i]) / rest(bands[i - 1]);
}

/// Whether the rest grows as steeply into this band as that of details does.
bool grows_steeply(const std::vector<NoiseBand>& bands, std::size_t i) {
  const double growth = growth_of_rest(bands, i, &NoiseBand::by_rms);
  return growth > choice_tuning.noise.steep ||
         std::sqrt(growth * growth_of_rest(bands, i, &NoiseBand::by_median)) >
             choice_tuning.noise.steep_by_both;
}

/// Whether a band is of noise, and the rest levels off in it.
bool levels_off(const std::vector<NoiseBand>& bands, std::size_t i) {
  return i < bands.size() && is_noise(bands[i]) &&
         growth_of_rest(bands, i, &NoiseBand::by_rms) <= choice_tuning.noise.level;
}

/// Whether the rest grows into a band so much that it may be of details with the next one.
bool may_grow_twice(const std::vector<NoiseBand>& bands, std::size_t i) {
  return growth_of_rest(bands, i, &NoiseBand::by_rms) > std::sqrt(choice_tuning.noise.steep_twice);
}

/// Whether the rest grows into a band, and into the next as well, as that of details does.
bool is_of_details(const std::vector<NoiseBand>& bands, std::size_t i) {
  if (i >= bands.size()) {
    return false;
  }
  const bool grows_twice =
      i + 1 < bands.size() && growth_of_rest(bands, i, &NoiseBand::by_rms) *
                                      growth_of_rest(bands, i + 1, &NoiseBand::by_rms) >
                                  choice_tuning.noise.steep_twice;
  return grows_twice || (grows_steeply(bands, i) && !levels_off(bands, i + 1));
}

/// Whether a band has clearly less than the one before, as after a regular pattern of a shape.
bool falls(const std::vector<NoiseBand>& bands, std::size_t i) {
  return i < bands.size() && bands[i].by_median < choice_tuning.noise.fall * bands[i - 1].by_median;
}

/// Whether the first bands grow as those of correlated noise, and not of details under white noise.
bool grows_clearly(const std::vector<NoiseBand>& bands) {
  return grows_at_first(bands) && !falls(bands, first_bands) && !is_of_details(bands, first_bands);
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
  const std::size_t i = first_longer_band(bands);
  if (i == bands.size() || !std::all_of(bands.begin(), bands.begin() + i + 1, is_noise) ||
      is_of_details(bands, i)) {
    return {};
  }
  const double white = std::pow(bands[0].by_rms, 2), all = std::pow(bands[i].by_rms, 2);
  const double quartile = bands[i].evenness * all - choice_tuning.noise.evenness_of_white * white;
  return quartile >= choice_tuning.noise.even_rest * (all - white) ? BandRange{0, i + 1}
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
  if (!std::all_of(bands.begin(), bands.end(), is_noise)) {
    return false;
  }
  if (grows_at_first(bands) && bands.size() == first_bands) {
    return true;
  }
  const std::size_t i = first_longer_band(bands);
  return bands.size() < last_mixed_band &&
         (i == bands.size() ||
          (i + 1 == bands.size() && (grows_steeply(bands, i) || may_grow_twice(bands, i))));
}

}  // namespace ibmfair
