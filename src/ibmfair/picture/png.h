// Pictures as PNG files.
#pragma once

#include <string>

#include "ibmfair/picture/image.h"

namespace ibmfair {

/// The bytes of a PNG file with the pixels of `image`, 8 bits per channel, marked as sRGB. The same
/// image always gives the same bytes.
std::string encode_png(const Image& image);

}  // namespace ibmfair
