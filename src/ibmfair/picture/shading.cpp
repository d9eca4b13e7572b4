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

/// The direction of a triangle.
struct Facet {
  Vec3 normal;            // unit, on the side from which the corners run anticlockwise
  double towards_viewer;  // cosine between the normal and the direction to the viewer

  Facet(const Points& X, const Triangles& F, Eigen::Index t, const Camera& camera) {
    const Vec3 a = X.row(F(t, 0));
    const Vec3 b = X.row(F(t, 1));
    const Vec3 c = X.row(F(t, 2));
    normal = double_area_vector(a, b, c).stableNormalized();
    towards_viewer = normal.dot(camera.towards_viewer((a + b + c) / 3.0));
  }
};

}  // namespace

Light light_of(Rgb colour) {
  return {decode(colour.red), decode(colour.green), decode(colour.blue)};
}

Rgb colour_of(const Light& light) {
  return {encode(light[0]), encode(light[1]), encode(light[2])};
}

bool shows_anticlockwise_sides(const Points& X, const Triangles& F, const Camera& camera,
                               const Visibility& seen) {
  const std::vector<std::int64_t> pixels = pixels_of_triangles(seen, F.rows());
  std::int64_t balance = 0;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    if (const std::int64_t count = pixels[static_cast<std::size_t>(t)]; count > 0) {
      balance += Facet(X, F, t, camera).towards_viewer < 0.0 ? -count : count;
    }
  }
  return balance >= 0;
}

std::vector<Light> shade_triangles(const Points& X, const Triangles& F, const Camera& camera,
                                   const Visibility& seen, const Paint& paint,
                                   bool front_is_anticlockwise) {
  const Vec3 key = camera.in_scene(key_direction());
  const Light front = light_of(paint.front), back = light_of(paint.back);
  const Light marked = light_of(paint.marked);
  const std::vector<std::int64_t> pixels = pixels_of_triangles(seen, F.rows());
  std::vector<Light> light(pixels.size(), Light::Zero());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const auto i = static_cast<std::size_t>(t);
    if (pixels[i] == 0) {
      continue;
    }
    const Facet facet(X, F, t, camera);
    const double side = facet.towards_viewer < 0.0 ? -1.0 : 1.0;
    light[i] += ambient +
                key_light * static_cast<float>(std::max(0.0, side * facet.normal.dot(key))) +
                headlight * static_cast<float>(side * facet.towards_viewer);
    if (t >= paint.marked_from) {
      light[i] *= marked;
    } else if (!paint.triangle.empty()) {
      light[i] *= light_of(paint.triangle[i]);
    } else {
      light[i] *= (side > 0.0) == front_is_anticlockwise ? front : back;
    }
  }
  return light;
}

}  // namespace ibmfair
