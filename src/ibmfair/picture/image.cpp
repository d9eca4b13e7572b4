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

Image stacked(std::span<const Image> images, Rgb background) {
  int width = 0, height = 0;
  for (const Image& image : images) {
    width = std::max(width, image.width);
    height += image.height;
  }

  Image column(width, height, background);
  int top = 0;
  for (const Image& image : images) {
    const int left = (width - image.width) / 2;
    for (int y = 0; y < image.height; ++y) {
      const auto line = image.pixels.begin() + std::ptrdiff_t{y} * image.width;
      std::copy_n(line, image.width,
                  column.pixels.begin() + std::ptrdiff_t{top + y} * width + left);
    }
    top += image.height;
  }
  return column;
}

Image without_empty_rows(const Image& image, Rgb background, int margin) {
  const auto is_drawn = [&](Rgb pixel) { return pixel != background; };
  const auto& pixels = image.pixels;
  const auto first = std::find_if(pixels.begin(), pixels.end(), is_drawn) - pixels.begin();
  const auto after = pixels.rend() - std::find_if(pixels.rbegin(), pixels.rend(), is_drawn);
  if (after == 0) {
    return image;
  }
  const auto top = std::max<std::ptrdiff_t>(0, first / image.width - margin);
  const auto bottom =
      std::min<std::ptrdiff_t>(image.height, (after - 1) / image.width + 1 + margin);

  Image cut(image.width, static_cast<int>(bottom - top));
  std::copy(pixels.begin() + top * image.width, pixels.begin() + bottom * image.width,
            cut.pixels.begin());
  return cut;
}

}  // namespace ibmfair
