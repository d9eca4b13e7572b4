// Images in memory, and arrangements of several images.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ibmfair {

/// A colour in sRGB, 8 bits per channel.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// width x height pixels, row by row from the top left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int width, int height, Rgb fill = {});

  Rgb& at(int column, int row) { return pixels[offset(column, row)]; }
  const Rgb& at(int column, int row) const { return pixels[offset(column, row)]; }

 private:
  std::size_t offset(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// The images from left to right, with `gap` pixels of `background` between them (gap >= 0),
/// aligned at the top; the space below a shorter image is filled with `background`.
Image side_by_side(std::span<const Image> images, int gap = 0, Rgb background = {255, 255, 255});

/// The images from top to bottom, centred on `background`.
Image stacked(std::span<const Image> images, Rgb background = {255, 255, 255});

/// The image without the rows of pure `background` at its top and bottom, except for `margin` rows
/// at each. An image with nothing but background is returned unchanged.
Image without_empty_rows(const Image& image, Rgb background, int margin);

}  // namespace ibmfair
