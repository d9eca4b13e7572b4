// Short texts in pictures, drawn with a round pen.
#pragma once

#include <string_view>

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// The width of `text` in pixels, with letters `height` pixels high (without descenders).
double text_width(std::string_view text, double height);

/// Writes `text` with the left end of its baseline at (left, baseline), in pixels from the top left
/// corner. Supported characters are letters (drawn in lower case), digits, `+-./^,()` and blanks;
/// any other character leaves a gap. Text outside the image is cut off.
void write_text(Image& image, std::string_view text, double left, double baseline, double height,
                Rgb colour);

}  // namespace ibmfair
