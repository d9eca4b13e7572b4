// Tells kinds of noise apart by what longer and longer cut-offs remove. The part between two
// successive cut-offs is called a band.
//
// Noise that is independent from vertex to vertex has the same standard deviation in all bands if
// each band is compared with the same band of white noise. Correlated noise, such as that of a
// depth camera, has a larger standard deviation in longer bands. So has the shape itself, but noise
// covers the surface evenly, and details of a shape are in few places (evenness.h). A regular
// pattern of a shape covers the surface even more evenly, and its heights have fewer large values
// than noise has. Outliers have more of them.
#pragma once

#include <cstddef>
#include <vector>

namespace ibmfair {

enum class NoiseKind {
  none,         ///< or so little that it is not more than details of a shape (no_noise.h)
  independent,  ///< from vertex to vertex
  outliers,     ///< independent, with few vertices that are much farther off than the others
  correlated,   ///< over some edges
  steps,        ///< of coordinates on few levels (level_steps.h)
};

/// The name in reports.
const char* name_of(NoiseKind kind);

/// What one cut-off removes and the previous one does not.
struct NoiseBand {
  double cutoff = 0;    ///< the longer of the two, length
  double evenness = 0;  ///< of the squared heights (evenness.h)
  /// Standard deviation of white noise of which the band has the same median height, and the same
  /// rms height; mean edge lengths, 0 if unknown.
  double by_median = 0, by_rms = 0;
  double white = 0;  ///< rms of white noise of the standard deviation 1 in this band, 0 if unknown
};

/// Positions in a list of bands, from `begin` to before `end`.
struct BandRange {
  std::size_t begin = 0, end = 0;
  bool empty() const { return begin == end; }
};

/// The bands that show that the noise is correlated; empty if it is not. That is so if the first
/// three bands, from the shortest cut-off upward, are of noise that grows with the cut-off; or, as
/// noise that is correlated over several edges hardly shows in the shortest bands, if the first one
/// is not of noise, but two successive later ones are, and are of more noise than the first one.
/// `bands`: from the shortest cut-off upward.
BandRange bands_of_correlated_noise(const std::vector<NoiseBand>& bands);

/// The bands that may be of white noise together with correlated noise; empty if there are none.
/// These are the bands up to the first one that has clearly more than white noise of the strength
/// of the first one, if the rest covers the surface as evenly as noise does, and does not grow from
/// band to band as details do. Creases of small parts, which reach everywhere, look alike
/// (crease_choice.h tells). If the first three bands show that the noise is correlated, they are
/// these and the next one, provided that it is of noise. `bands`: from the shortest cut-off upward.
BandRange bands_of_mixed_noise(const std::vector<NoiseBand>& bands);

/// Whether the first two bands are like those of white noise: even, and equally strong.
bool is_white(const std::vector<NoiseBand>& bands);

/// Whether a longer cut-off may show that the noise is correlated.
bool may_tell_more(const std::vector<NoiseBand>& bands);

}  // namespace ibmfair
