// What the colours of a picture mean.
#pragma once

#include <string>

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// A scale of values that colours show.
struct ColourScale {
  std::string title;  ///< with the unit
  double low = 0, high = 1;
  bool diverging = false;

  /// Of a value; grey for NaN.
  Rgb colour(double value) const;
};

/// A strip `width` pixels wide: the title, and a bar of all colours with numbers below it.
Image draw_legend(const ColourScale& scale, int width, Rgb background);

}  // namespace ibmfair
