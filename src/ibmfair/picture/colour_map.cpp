#include "ibmfair/picture/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "ibmfair/picture/shading.h"

namespace ibmfair {
namespace {

constexpr Rgb without_value{128, 128, 128};

// Evenly spaced colours of viridis; linear interpolation between them is accurate to two units of
// 255.
constexpr std::array<Rgb, 10> viridis{{{0x44, 0x01, 0x54},
                                       {0x48, 0x28, 0x78},
                                       {0x3e, 0x49, 0x89},
                                       {0x31, 0x68, 0x8e},
                                       {0x26, 0x82, 0x8e},
                                       {0x1f, 0x9e, 0x89},
                                       {0x35, 0xb7, 0x79},
                                       {0x6e, 0xce, 0x58},
                                       {0xb5, 0xde, 0x2b},
                                       {0xfd, 0xe7, 0x25}}};

/// Moreland's polar form of CIELAB: the distance from black, the angle of saturation, the hue.
struct Msh {
  double magnitude, saturation, hue;
};

constexpr Msh cool{80, 1.08, -1.1}, grey{88, 0, 0}, warm{80, 1.08, 0.5};

/// The hue of an end of the scale where it fades into grey, rotated so that colour steps look
/// equally large.
double faded_hue(const Msh& end) {
  const double room = grey.magnitude * grey.magnitude - end.magnitude * end.magnitude;
  const double turn = end.saturation * std::sqrt(room) / (end.magnitude * std::sin(end.saturation));
  return end.hue > -std::numbers::pi / 3 ? end.hue + turn : end.hue - turn;
}

Rgb colour_of_msh(const Msh& colour) {
  const double L = colour.magnitude * std::cos(colour.saturation);
  const double a = colour.magnitude * std::sin(colour.saturation) * std::cos(colour.hue);
  const double b = colour.magnitude * std::sin(colour.saturation) * std::sin(colour.hue);
  const auto linear = [](double f) {
    constexpr double knee = 6.0 / 29;
    return f > knee ? f * f * f : 3 * knee * knee * (f - 4.0 / 29);
  };
  const double y = (L + 16) / 116;
  const Eigen::Vector3d xyz(0.9505 * linear(y + a / 500), linear(y), 1.089 * linear(y - b / 200));
  Eigen::Matrix3d to_rgb;
  to_rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  return colour_of((to_rgb * xyz).cast<float>().array());
}

std::uint8_t between(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
}

}  // namespace

Rgb sequential_colour(double t) {
  if (std::isnan(t)) {
    return without_value;
  }
  const double place = std::clamp(t, 0.0, 1.0) * (viridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  const double share = place - static_cast<double>(i);
  const Rgb& a = viridis[i];
  const Rgb& b = viridis[i + 1];
  return {between(a.red, b.red, share), between(a.green, b.green, share),
          between(a.blue, b.blue, share)};
}

Rgb diverging_colour(double t) {
  if (std::isnan(t)) {
    return without_value;
  }
  const double share = std::abs(2 * std::clamp(t, 0.0, 1.0) - 1);  // 0 in the middle
  const Msh& end = t < 0.5 ? cool : warm;
  const double hue = faded_hue(end);
  return colour_of_msh({grey.magnitude + share * (end.magnitude - grey.magnitude),
                        share * end.saturation, hue + share * (end.hue - hue)});
}

}  // namespace ibmfair
