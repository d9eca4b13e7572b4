// The legend that explains the colours of a picture.
#pragma once

#include <string>

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// A mapping from values to colours.
struct ColourScale {
  std::string title;  ///< with the unit
  double low = 0, high = 1;
  bool diverging = false;

  /// The colour of a value; grey for NaN.
  Rgb colour(double value) const;
};

/// The legend, `width` pixels wide: the title, and a bar of all colours with numbers below it.
Image draw_legend(const ColourScale& scale, int width, Rgb background);

}  // namespace ibmfair
