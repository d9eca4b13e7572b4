#include "ibmfair/picture/lettering.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "ibmfair/picture/shading.h"

namespace ibmfair {
namespace {

/// The path of the pen on a grid: two digits per point, across and up, and a blank between strokes.
/// The baseline is at height 2; letters without ascenders end at 6, those with ascenders at 8.
struct Glyph {
  char letter;
  std::string_view strokes;
};

constexpr std::array glyphs{
    Glyph{'0', "123243473818070312"},
    Glyph{'1', "072822 1232"},
    Glyph{'2', "07183847460242"},
    Glyph{'3', "084826364543321203"},
    Glyph{'4', "32380444"},
    Glyph{'5', "480806364543321203"},
    Glyph{'6', "473818070312324344351504"},
    Glyph{'7', "084812"},
    Glyph{'8', "15060718384746351504031232434435"},
    Glyph{'9', "031232434738180706153546"},
    Glyph{'+', "0545 2327"},
    Glyph{'-', "0535"},
    Glyph{'.', "0202"},
    Glyph{',', "120201"},
    Glyph{'/', "0248"},
    Glyph{'^', "061826"},
    Glyph{'(', "18070312"},
    Glyph{')', "08171302"},
    Glyph{'a', "4642 4536160503123243"},
    Glyph{'b', "0802 0516364543321203"},
    Glyph{'c', "4536160503123243"},
    Glyph{'d', "4842 4536160503123243"},
    Glyph{'e', "04444536160503123243"},
    Glyph{'f', "38281712 0636"},
    Glyph{'g', "4641301001 4536160503123243"},
    Glyph{'h', "0802 0516364542"},
    Glyph{'i', "0602 0808"},
    Glyph{'j', "161100 1818"},
    Glyph{'k', "0802 3603 1432"},
    Glyph{'l', "0802"},
    Glyph{'m', "0602 05162522 25364542"},
    Glyph{'n', "0602 0516364542"},
    Glyph{'o', "123243453616050312"},
    Glyph{'p', "0600 0516364543321203"},
    Glyph{'q', "4640 4536160503123243"},
    Glyph{'r', "0602 051636"},
    Glyph{'s', "45361605143443321203"},
    Glyph{'t', "18132232 0636"},
    Glyph{'u', "0603123243 4642"},
    Glyph{'v', "062246"},
    Glyph{'w', "0612253246"},
    Glyph{'x', "0642 4602"},
    Glyph{'y', "0622 4610"},
    Glyph{'z', "06460242"},
};

// Lengths in units of the grid.
constexpr double letter_height = 6;  // height of tall letters above the baseline
constexpr double gap = 1.7;
constexpr double blank = 2.5;
constexpr double pen_radius = 0.38;

std::string_view strokes_of(char letter) {
  const auto small = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const auto found = std::find_if(glyphs.begin(), glyphs.end(),
                                  [small](const Glyph& glyph) { return glyph.letter == small; });
  return found == glyphs.end() ? std::string_view() : found->strokes;
}

/// A point of the grid relative to the left end of the baseline.
Eigen::Vector2d point_at(std::string_view strokes, std::size_t place) {
  return {strokes[place] - '0', strokes[place + 1] - '2'};
}

double advance(std::string_view strokes) {
  double width = 0;
  for (std::size_t i = 0; i + 1 < strokes.size(); i += strokes[i] == ' ' ? 1 : 2) {
    if (strokes[i] != ' ') {
      width = std::max(width, point_at(strokes, i).x());
    }
  }
  return strokes.empty() ? blank : width + gap;
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * (b - a)).norm();
}

double distance_to_glyph(const Eigen::Vector2d& p, std::string_view strokes) {
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 3 < strokes.size(); i += 2) {
    if (strokes[i + 2] == ' ') {
      i += 1;  // the pen is lifted
      continue;
    }
    distance =
        std::min(distance, distance_to_segment(p, point_at(strokes, i), point_at(strokes, i + 2)));
  }
  return distance;
}

void draw_glyph(Image& image, std::string_view strokes, double left, double baseline, double scale,
                Rgb colour) {
  const int first_column = std::max(0, static_cast<int>(left - scale));
  const int last_column = std::min(image.width - 1, static_cast<int>(left + 5 * scale) + 1);
  const int first_row = std::max(0, static_cast<int>(baseline - 7 * scale));
  const int last_row = std::min(image.height - 1, static_cast<int>(baseline + 3 * scale) + 1);
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const Eigen::Vector2d p((column + 0.5 - left) / scale, (baseline - row - 0.5) / scale);
      const double inside = scale * (pen_radius - distance_to_glyph(p, strokes)) + 0.5;  // pixels
      const auto cover = static_cast<float>(std::clamp(inside, 0.0, 1.0));
      Rgb& pixel = image.at(column, row);
      pixel =
          cover > 0 ? colour_of(cover * light_of(colour) + (1 - cover) * light_of(pixel)) : pixel;
    }
  }
}

}  // namespace

double text_width(std::string_view text, double height) {
  double width = 0;
  for (const char letter : text) {
    width += advance(strokes_of(letter));
  }
  return text.empty() ? 0 : (width - gap) * height / letter_height;
}

void write_text(Image& image, std::string_view text, double left, double baseline, double height,
                Rgb colour) {
  const double scale = height / letter_height;
  for (const char letter : text) {
    const std::string_view strokes = strokes_of(letter);
    draw_glyph(image, strokes, left, baseline, scale, colour);
    left += scale * advance(strokes);
  }
}

}  // namespace ibmfair
