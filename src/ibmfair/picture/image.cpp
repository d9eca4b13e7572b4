#include "ibmfair/picture/image.h"

#include <algorithm>

namespace ibmfair {

Image::Image(int width, int height, Rgb fill)
    : width(width),
      height(height),
      pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {}

Image side_by_side(std::span<const Image> images, int gap, Rgb background) {
  int width = images.empty() ? 0 : gap * (static_cast<int>(images.size()) - 1);
  int height = 0;
  for (const Image& image : images) {
    width += image.width;
    height = std::max(height, image.height);
  }

  Image row(width, height, background);
  int left = 0;
  for (const Image& image : images) {
    for (int y = 0; y < image.height; ++y) {
      const auto line = image.pixels.begin() + std::ptrdiff_t{y} * image.width;
      std::copy_n(line, image.width, row.pixels.begin() + std::ptrdiff_t{y} * width + left);
    }
    left += image.width + gap;
  }
  return row;
}

}  // namespace ibmfair
