// Short texts in pictures, drawn with a round pen.
#pragma once

#include <string_view>

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// How wide `text` is in pixels, with letters `height` pixels high (those without a tail).
double text_width(std::string_view text, double height);

/// Writes `text` (letters, shown as small ones, digits, `+-./^,()` and blanks; anything else is a
/// gap) with its baseline's left end at (left, baseline), pixels from the top left corner. What is
/// outside of the image is cut off.
void write_text(Image& image, std::string_view text, double left, double baseline, double height,
                Rgb colour);

}  // namespace ibmfair
