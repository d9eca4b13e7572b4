#include "ibmfair/picture/legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/picture/colour_map.h"
#include "ibmfair/picture/lettering.h"

namespace ibmfair {
namespace {

constexpr Rgb ink{40, 40, 48};
constexpr double letter_size = 13;  // pixels
constexpr int bar_height = 16;
constexpr int bar_top = 34;
constexpr int tick_length = 5;
constexpr int strip_height = 92;
constexpr int ticks = 5;

void write_centred(Image& image, const std::string& text, double centre, double baseline) {
  const double width = text_width(text, letter_size);
  const double left = std::clamp(centre - width / 2, 0.0, std::max(0.0, image.width - width));
  write_text(image, text, left, baseline, letter_size, ink);
}

}  // namespace

Rgb ColourScale::colour(double value) const {
  const double t = high > low ? (value - low) / (high - low) : 0.5 + 0 * value;
  return diverging ? diverging_colour(t) : sequential_colour(t);
}

Image draw_legend(const ColourScale& scale, int width, Rgb background) {
  Image strip(width, strip_height, background);
  const int bar = std::min(width - 2, std::max(width / 2, 360));
  const int left = (width - bar) / 2;
  write_centred(strip, scale.title, width / 2.0, bar_top - 12);
  for (int column = 0; column < bar; ++column) {
    const double value = scale.low + (scale.high - scale.low) * (column + 0.5) / bar;
    for (int row = 0; row < bar_height; ++row) {
      strip.at(left + column, bar_top + row) = scale.colour(value);
    }
  }
  for (int tick = 0; tick < ticks; ++tick) {
    const double share = static_cast<double>(tick) / (ticks - 1);
    const int column = left + static_cast<int>(std::lround(share * (bar - 1)));
    for (int row = 0; row < tick_length; ++row) {
      strip.at(column, bar_top + bar_height + row) = ink;
    }
    write_centred(strip, fmt::format("{:.3g}", scale.low + share * (scale.high - scale.low)),
                  column + 0.5, bar_top + bar_height + tick_length + 6 + letter_size);
  }
  return strip;
}

}  // namespace ibmfair
