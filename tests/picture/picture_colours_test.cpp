// Laws of coloured pictures: colours keep the order of numbers, texts and legends are legible, and
// a picture of a field shows at which places the field is large.
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/picture/colour_map.h"
#include "ibmfair/picture/field_picture.h"
#include "ibmfair/picture/legend.h"
#include "ibmfair/picture/lettering.h"
#include "ibmfair/picture/shading.h"
#include "ibmfair/shapes/grids.h"

namespace ibmfair {
namespace {

constexpr Rgb paper{255, 255, 255};
constexpr Rgb black{0, 0, 0};

/// The lightness L* of CIELAB, 0 to 100.
double lightness(Rgb colour) {
  const Light light = light_of(colour);
  const double Y = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  return Y > 0.008856 ? 116 * std::cbrt(Y) - 16 : 903.3 * Y;
}

Image text_image(const std::string& text, double height) {
  Image image(static_cast<int>(std::ceil(text_width(text, height))) + 20,
              static_cast<int>(3 * height), paper);
  write_text(image, text, 10, 2 * height, height, black);
  return image;
}

double ink(const Image& image) {
  double sum = 0;
  for (const Rgb pixel : image.pixels) {
    sum += 1 - light_of(pixel)[1];
  }
  return sum;
}

TEST(ColourMap, MoreIsLighterInEvenSteps) {
  constexpr int steps = 64;
  const double whole = lightness(sequential_colour(1)) - lightness(sequential_colour(0));
  EXPECT_GT(whole, 70);
  for (int i = 0; i < steps; ++i) {
    const double step = lightness(sequential_colour((i + 1.0) / steps)) -
                        lightness(sequential_colour(static_cast<double>(i) / steps));
    EXPECT_GT(step, 0.5 * whole / steps) << i;
    EXPECT_LT(step, 1.5 * whole / steps) << i;
  }
}

TEST(ColourMap, SignsDarkenAlikeAndDifferInHue) {
  for (int i = 0; i < 32; ++i) {
    const double t = i / 64.0;
    const Rgb below = diverging_colour(t), above = diverging_colour(1 - t);
    EXPECT_NEAR(lightness(below), lightness(above), 1.5) << t;
    EXPECT_GT(below.blue, below.red) << t;
    EXPECT_GT(above.red, above.blue) << t;
    EXPECT_LT(lightness(below), lightness(diverging_colour(t + 1.0 / 64)) + 0.2) << t;
  }
  const Rgb cool = diverging_colour(0), warm = diverging_colour(1);
  EXPECT_NEAR(cool.red, 59, 1);  // the published values
  EXPECT_NEAR(cool.blue, 192, 1);
  EXPECT_NEAR(warm.red, 180, 1);
  EXPECT_NEAR(warm.blue, 38, 1);
}

TEST(ColourMap, EndsHoldBeyondAndNothingIsGrey) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& colour : {sequential_colour, diverging_colour}) {
    EXPECT_EQ(colour(-3), colour(0));
    EXPECT_EQ(colour(infinity), colour(1));
    const Rgb grey = colour(nan);
    EXPECT_TRUE(grey.red == grey.green && grey.green == grey.blue);
  }
}

TEST(Lettering, EveryLetterIsDrawnAndUnlikeTheOthers) {
  const std::string letters = "0123456789abcdefghijklmnopqrstuvwxyz+-.,/^()";
  std::vector<Image> images;
  for (const char letter : letters) {
    images.push_back(text_image(std::string(1, letter), 24));
    EXPECT_GT(ink(images.back()), 5) << letter;
    for (std::size_t i = 0; i + 1 < images.size(); ++i) {
      EXPECT_FALSE(images[i].width == images.back().width &&
                   images[i].pixels == images.back().pixels)
          << letter << letters[i];
    }
  }
}

TEST(Lettering, InkGrowsWithTheSquareOfTheHeightAndStaysInTheWidth) {
  const std::string text = "mean curvature, 1/length^2";
  EXPECT_NEAR(ink(text_image(text, 40)) / ink(text_image(text, 20)), 4, 0.2);
  EXPECT_NEAR(text_width(text, 40), 2 * text_width(text, 20), 1e-9);
  const Image image = text_image(text, 20);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < 8; ++column) {
      EXPECT_EQ(image.at(column, row), paper);
      EXPECT_EQ(image.at(image.width - 1 - column, row), paper);
    }
  }
}

TEST(Lettering, IsCutOffAtTheImage) {
  Image image(10, 10, paper);
  write_text(image, "8888", -20, 4, 12, black);
  write_text(image, "8888", 5, 40, 12, black);
  write_text(image, "8", 1e6, 1e6, 12, black);
  EXPECT_EQ(image.pixels.size(), 100U);
}

TEST(Legend, ShowsAllColoursInOrder) {
  for (const bool diverging : {false, true}) {
    const ColourScale scale{"height", -2, 2, diverging};
    const Image strip = draw_legend(scale, 600, paper);
    EXPECT_EQ(strip.width, 600);
    const int middle = 42;  // a row of the bar
    int first = 0;
    while (strip.at(first, middle) == paper)
      ++first;
    int last = strip.width - 1;
    while (strip.at(last, middle) == paper)
      --last;
    EXPECT_GT(last - first, 250);
    for (int column = first; column <= last; ++column) {
      const double t = (column - first + 0.5) / (last - first + 1);
      EXPECT_EQ(strip.at(column, middle), scale.colour(-2 + 4 * t)) << column;
    }
  }
}

TEST(Legend, OneValueHasTheColourOfTheMiddle) {
  const ColourScale scale{"flat", 3, 3, false};
  EXPECT_EQ(scale.colour(3), sequential_colour(0.5));
}

TEST(FieldPicture, IsLighterWhereTheFieldIsLarge) {
  // Triangles that are flattened on the left have a lower quality there.
  const TriangleMesh sheet = make_plane(1, {.rows = 12});
  Points X = sheet.X;
  const double left = X.col(0).minCoeff(), right = X.col(0).maxCoeff();
  for (auto x : X.rowwise()) {
    const double t = (x[0] - left) / (right - left);
    x[1] = 0.5 + (x[1] - 0.5) * (0.2 + 0.8 * t);
  }
  const Topology topology = build_topology(X, sheet.F);
  RenderOptions options;
  options.width = options.height = 90;
  options.view = {.from = {0, 0, 1}, .field_of_view = 0};
  options.silhouettes = false;
  const std::array<FieldState, 1> states{{{X, topology}}};
  const Image image = render_field(surface_field("triangle_quality"), states, options);
  const int row = 45;
  EXPECT_GT(lightness(image.at(75, row)), lightness(image.at(15, row)) + 15);
}

TEST(FieldPicture, StatesWithoutAStartStayPlain) {
  const TriangleMesh sheet = make_plane(1, {.rows = 6});
  const Points moved = 1.1 * sheet.X;
  const Topology topology = build_topology(sheet.X, sheet.F);
  const std::array<FieldState, 2> states{{{sheet.X, topology}, {moved, topology, &sheet.X}}};
  for (const SurfaceField& field : surface_fields()) {
    RenderOptions options;
    options.width = options.height = 60;
    const Image image = render_field(field, states, options);
    EXPECT_EQ(image.width, 120) << field.name;
    if (field.name == "displacement") {
      const Rgb plain = image.at(30, 20), coloured = image.at(90, 12);
      EXPECT_LT(std::abs(plain.red - plain.blue), 25);  // near grey
      EXPECT_GT(std::abs(coloured.green - coloured.red) + std::abs(coloured.green - coloured.blue),
                25);
    }
  }
}

}  // namespace
}  // namespace ibmfair
