#include "ibmfair/picture/shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr float ambient = 0.06F;
constexpr float key_light = 0.80F;
constexpr float headlight = 0.14F;

/// The direction to the key light, in the axes of the picture. It is oblique enough that the two
/// flanks of a ripple differ in brightness on a surface that faces the viewer.
Vec3 key_direction() {
  return Vec3(-0.65, 0.6, 0.47).normalized();
}

float decode(std::uint8_t byte) {
  const float s = static_cast<float>(byte) / 255.0F;
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t encode(float light) {
  const float s =
      light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(s, 0.0F, 1.0F)));
}

std::vector<std::int64_t> pixels_of_triangles(const Visibility& seen, Eigen::Index triangles) {
  std::vector<std::int64_t> pixels(static_cast<std::size_t>(triangles), 0);
  for (const Index t : seen.triangle) {
    if (t != Visibility::nothing) {
      ++pixels[t];
    }
  }
  return pixels;
}

}  // namespace

Light light_of(Rgb colour) {
  return {decode(colour.red), decode(colour.green), decode(colour.blue)};
}

Rgb colour_of(const Light& light) {
  return {encode(light[0]), encode(light[1]), encode(light[2])};
}

std::vector<Light> shade_triangles(const Points& X, const Triangles& F, const Camera& camera,
                                   const Visibility& seen, const Paint& paint) {
  const Vec3 key = camera.in_scene(key_direction());
  const std::vector<std::int64_t> pixels = pixels_of_triangles(seen, F.rows());
  std::vector<Light> light(pixels.size(), Light::Zero());
  std::vector<std::uint8_t> faces_viewer(pixels.size(), 0);
  std::int64_t balance = 0;  // pixels that show the front of their triangle, minus the others

  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const auto i = static_cast<std::size_t>(t);
    if (pixels[i] == 0) {
      continue;
    }
    const Vec3 a = X.row(F(t, 0));
    const Vec3 b = X.row(F(t, 1));
    const Vec3 c = X.row(F(t, 2));
    const Vec3 n = double_area_vector(a, b, c).stableNormalized();
    const double towards_viewer = n.dot(camera.towards_viewer((a + b + c) / 3.0));
    const double side = towards_viewer < 0.0 ? -1.0 : 1.0;
    faces_viewer[i] = side > 0.0 ? 1 : 0;
    balance += side > 0.0 ? pixels[i] : -pixels[i];
    light[i] += ambient + key_light * static_cast<float>(std::max(0.0, side * n.dot(key))) +
                headlight * static_cast<float>(side * towards_viewer);
  }

  const bool front_faces_viewer = balance >= 0;
  const Light front = light_of(paint.front);
  const Light back = light_of(paint.back);
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (!paint.triangle.empty()) {
      light[i] *= light_of(paint.triangle[i]);
    } else {
      light[i] *= (faces_viewer[i] != 0) == front_faces_viewer ? front : back;
    }
  }
  return light;
}

}  // namespace ibmfair
