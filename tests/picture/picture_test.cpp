// Laws of the pictures: the part of the scene that the camera shows, the triangles that hide
// others, the effects of light and paint, and the exact storage of pixels in PNG files.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/picture/png.h"
#include "ibmfair/picture/render.h"
#include "ibmfair/picture/visibility.h"
#include "support/meshes.h"

namespace ibmfair {
namespace {

const std::array<View, 4> views{View{}, View{.from = {0.0, 0.0, -1.0}, .field_of_view = 0.0},
                                View{.from = {0.0, 5.0, 2.0}, .field_of_view = 0.8, .margin = 0.2},
                                View{.from = {-1.0, -2.0, 0.1}, .up = {0.0, 0.0, 1.0}}};

Points square_at(double depth, double half_side) {
  Points X(4, 3);
  X << -half_side, -half_side, depth, half_side, -half_side, depth, half_side, half_side, depth,
      -half_side, half_side, depth;
  return X;
}

Triangles two_triangles(Index first) {
  Triangles F(2, 3);
  F << first, first + 1, first + 2, first, first + 2, first + 3;
  return F;
}

RenderOptions small_picture() {
  return {.width = 60, .height = 40, .samples = 2};
}

/// A view straight on, without perspective and margins: one square fills a square picture.
RenderOptions straight_on(int side) {
  return {.width = side,
          .height = side,
          .samples = 1,
          .view = {.from = {0.0, 0.0, 1.0}, .field_of_view = 0.0, .margin = 0.0},
          .silhouettes = false};
}

std::size_t pixels_unlike(const Image& image, Rgb colour) {
  return image.pixels.size() -
         static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), colour));
}

std::size_t pixels_that_differ(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    count += std::abs(a.pixels[i].green - b.pixels[i].green) > 1 ? 1 : 0;
  }
  return count;
}

TEST(Image, SideBySideKeepsEveryPixelAndFillsTheRest) {
  const std::array<Image, 2> images{Image(2, 3, {1, 2, 3}), Image(4, 1, {7, 8, 9})};
  const Image row = side_by_side(images, 5, {50, 60, 70});
  ASSERT_EQ(row.width, 2 + 5 + 4);
  ASSERT_EQ(row.height, 3);
  for (int y = 0; y < row.height; ++y) {
    for (int x = 0; x < row.width; ++x) {
      const bool in_second = x >= 7 && y < 1;
      const Rgb expected = x < 2 ? Rgb{1, 2, 3} : in_second ? Rgb{7, 8, 9} : Rgb{50, 60, 70};
      EXPECT_EQ(row.at(x, y), expected) << x << ' ' << y;
    }
  }
}

TEST(Image, WithoutEmptyRowsKeepsWhatIsDrawnAndTheMargin) {
  const Rgb white{255, 255, 255};
  Image image(5, 20, white);
  EXPECT_TRUE(without_empty_rows(image, white, 1).pixels == image.pixels) << "nothing is drawn";
  image.at(4, 7) = {1, 1, 1};
  image.at(0, 9) = {2, 2, 2};
  for (const auto& [margin, top, height] : {std::array{0, 7, 3}, {2, 5, 7}, {100, 0, 20}}) {
    const Image cut = without_empty_rows(image, white, margin);
    ASSERT_EQ(cut.width, 5);
    ASSERT_EQ(cut.height, height) << margin;
    EXPECT_EQ(cut.at(4, 7 - top), image.at(4, 7));
    EXPECT_EQ(cut.at(0, 9 - top), image.at(0, 9));
    EXPECT_EQ(pixels_unlike(cut, white), 2U);
  }
}

TEST(Png, GivesEveryPixelBack) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 200}}) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const auto k = static_cast<std::uint8_t>(i * 37);
      image.pixels[i] = {k, static_cast<std::uint8_t>(255 - k), static_cast<std::uint8_t>(i / 256)};
    }
    const std::string bytes = encode_png(image);
    EXPECT_EQ(bytes, encode_png(image));

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0);
    header.format = PNG_FORMAT_RGB;
    ASSERT_EQ(static_cast<int>(header.width), width);
    ASSERT_EQ(static_cast<int>(header.height), height);
    std::vector<Rgb> read(image.pixels.size());
    ASSERT_NE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr), 0);
    EXPECT_EQ(read, image.pixels);
  }
  EXPECT_THROW(encode_png(Image{}), BadOption);
}

TEST(Camera, HoldsEveryPointAndFillsThePicture) {
  constexpr int width = 300;
  constexpr int height = 200;
  for (const auto& [name, mesh] : test::at_all_scales(test::good_meshes())) {
    for (const View& view : views) {
      SCOPED_TRACE(name);
      const Camera camera(view, width, height, mesh.X);
      double left = width;
      double right = 0.0;
      double top = height;
      double bottom = 0.0;
      for (const auto& x : mesh.X.rowwise()) {
        const Projected p = camera.project(x.transpose());
        left = std::min(left, p.column);
        right = std::max(right, p.column);
        top = std::min(top, p.row);
        bottom = std::max(bottom, p.row);
      }
      const double margin = view.margin * height;
      const double slack = 1e-3;
      EXPECT_GE(left, margin - slack);
      EXPECT_GE(top, margin - slack);
      EXPECT_LE(right, width - margin + slack);
      EXPECT_LE(bottom, height - margin + slack);
      const bool touches_sides = left < margin + slack && right > width - margin - slack;
      const bool touches_top_and_bottom = top < margin + slack && bottom > height - margin - slack;
      EXPECT_TRUE(touches_sides || touches_top_and_bottom);
    }
  }
}

TEST(Camera, NearnessIsLinearInThePictureAndLargerInFront) {
  Points segment(2, 3);
  segment << -1.0, 0.3, -2.0, 0.8, -0.5, 1.0;
  for (const View& view : views) {
    const Camera camera(view, 300, 200, segment);
    const Vec3 start = segment.row(0);
    const Vec3 end = segment.row(1);
    const Projected a = camera.project(start);
    const Projected b = camera.project(end);
    EXPECT_EQ(a.nearness<b.nearness, (end - start).dot(view.from)> 0.0);
    for (const double t : {0.25, 0.5, 0.75}) {
      const Projected p = camera.project((1.0 - t) * start + t * end);
      const double s = std::abs(b.column - a.column) > 1.0
                           ? (p.column - a.column) / (b.column - a.column)
                           : (p.row - a.row) / (b.row - a.row);
      EXPECT_NEAR(p.column, a.column + s * (b.column - a.column), 1e-8);
      EXPECT_NEAR(p.row, a.row + s * (b.row - a.row), 1e-8);
      EXPECT_NEAR(p.nearness, a.nearness + s * (b.nearness - a.nearness), 1e-8);
    }
  }
}

TEST(Visibility, TheNearerSquareHidesTheOtherInAnyOrder) {
  Points X(8, 3);
  X << square_at(1.0, 0.5), square_at(0.0, 1.0);
  const Index far_first[] = {4, 0};
  const Index near_first[] = {0, 4};
  for (const auto& order : {far_first, near_first}) {
    Triangles F(4, 3);
    F << two_triangles(order[0]), two_triangles(order[1]);
    const Camera camera(straight_on(40).view, 40, 40, X);
    const Visibility seen = find_visible(X, F, camera, 40, 40);
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 40; ++column) {
        const bool in_front = std::min(row, column) >= 10 && std::max(row, column) < 30;
        const Index t = seen.triangle[seen.pixel(column, row)];
        ASSERT_NE(t, Visibility::nothing);
        EXPECT_EQ(F(t, 0), in_front ? 0 : 4) << row << ' ' << column;
      }
    }
  }
}

TEST(Visibility, ASheetHasNoGapsAlongItsEdges) {
  const Mesh sheet = test::flat_sheet(17, 13);
  const Triangles F = triangulate(sheet).F;
  for (const View& view :
       {View{.margin = 0.0}, View{.from = {0.3, -0.2, 1.0}, .up = {0.7, 1, 0}}}) {
    const Camera camera(view, 211, 173, sheet.X);
    const Visibility seen = find_visible(sheet.X, F, camera, 211, 173);
    std::size_t covered = 0;
    for (int row = 0; row < seen.height; ++row) {
      const auto first = seen.triangle.begin() + std::ptrdiff_t{row} * seen.width;
      const auto last = first + seen.width;
      const auto is_covered = [](Index t) { return t != Visibility::nothing; };
      const auto begin = std::find_if(first, last, is_covered);
      const auto end = std::find_if_not(begin, last, is_covered);
      EXPECT_EQ(std::find_if(end, last, is_covered), last) << "a gap in row " << row;
      covered += static_cast<std::size_t>(end - begin);
    }
    EXPECT_GT(covered, seen.triangle.size() / 4);
  }
}

TEST(Render, IsTheSameForEveryOrientation) {
  for (const auto& [name, mesh] : test::closed_meshes()) {
    const Triangles F = triangulate(mesh).F;
    const Triangles turned = F.rowwise().reverse();
    const Image image = render({mesh.X, F}, small_picture());
    EXPECT_GT(pixels_unlike(image, {255, 255, 255}), 100U) << name;
    const Image other = render({mesh.X, turned}, small_picture());
    // Rounding may give pixels at common edges to the other triangle.
    EXPECT_LT(pixels_that_differ(image, other), image.pixels.size() / 100) << name;
  }
}

TEST(Render, IsTheSameAtEveryScale) {
  for (const auto& [name, mesh] : test::good_meshes()) {
    const Triangles F = triangulate(mesh).F;
    const Image image = render({mesh.X, F}, small_picture());
    for (const double scale : {std::ldexp(1.0, -30), std::ldexp(1.0, 30)}) {
      EXPECT_TRUE(image.pixels == render({scale * mesh.X, F}, small_picture()).pixels) << name;
    }
  }
}

TEST(Render, PaintsTheTwoSidesDifferently) {
  Points X(8, 3);
  X << square_at(0.0, 1.0), square_at(0.5, 0.25);
  Triangles F(4, 3);
  F << two_triangles(0), two_triangles(4).rowwise().reverse();
  const RenderOptions options = straight_on(40);
  Paint paint{.front = {0, 0, 255}, .back = {255, 0, 0}};
  const Image image = render({X, F, paint}, options);
  EXPECT_GT(image.at(2, 2).blue, 60);
  EXPECT_EQ(image.at(2, 2).red, 0);
  EXPECT_GT(image.at(20, 20).red, 60);
  EXPECT_EQ(image.at(20, 20).blue, 0);

  paint.triangle = {{0, 255, 0}, {0, 255, 0}, {0, 255, 0}, {0, 255, 0}};
  const Image green = render({X, F, paint}, options);
  EXPECT_TRUE(std::all_of(green.pixels.begin(), green.pixels.end(), [](Rgb pixel) {
    return pixel.green > 60 && pixel.red == 0 && pixel.blue == 0;
  }));
  paint.triangle.pop_back();
  EXPECT_THROW(render({X, F, paint}, options), BadOption);
}

TEST(Render, LightTellsSlopesApart) {
  // A gable whose ridge runs up the picture: the left flank is turned to the light.
  Points X(6, 3);
  X << -1, -1, 0, -1, 1, 0, 0, -1, 0.4, 0, 1, 0.4, 1, -1, 0, 1, 1, 0;
  Triangles F(4, 3);
  F << 0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3;
  const Image image = render({X, F}, straight_on(40));
  EXPECT_GT(image.at(10, 20).green, image.at(30, 20).green + 40);
}

TEST(Render, DrawsSilhouettesOnlyWhereTheSurfaceBreaksOff) {
  Points X(8, 3);
  X << square_at(0.0, 1.0), square_at(0.5, 0.5);
  Triangles F(4, 3);
  F << two_triangles(0), two_triangles(4);
  RenderOptions options = straight_on(80);
  const Image plain = render({X, F}, options);
  options.silhouettes = true;
  const Image drawn = render({X, F}, options);
  EXPECT_EQ(drawn.at(5, 40), plain.at(5, 40)) << "on the lower square";
  EXPECT_EQ(drawn.at(40, 40), plain.at(40, 40)) << "on the upper square";
  EXPECT_LT(drawn.at(20, 40).green, plain.at(20, 40).green / 2) << "on the upper one's edge";

  // A slope, however steep, is no silhouette: no line is drawn inside it.
  const Mesh sheet = test::flat_sheet(4, 4);
  options.view = {.from = {0.0, -1.0, 0.15}, .up = {0.0, 0.0, 1.0}, .margin = 0.1};
  const Triangles G = triangulate(sheet).F;
  const Image slope = render({sheet.X, G}, options);
  EXPECT_GT(slope.at(40, 40).green, 60);
}

TEST(Render, LeavesOutWhatIsNotFinite) {
  const Mesh sheet = test::flat_sheet(6, 6);
  const Triangles F = triangulate(sheet).F;
  Triangles more(F.rows() + 2, 3);
  more << F, two_triangles(static_cast<Index>(sheet.X.rows()));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Points X(sheet.X.rows() + 4, 3);
    X << sheet.X, Points::Constant(4, 3, bad);
    EXPECT_EQ(render({X, more}, small_picture()).pixels,
              render({sheet.X, F}, small_picture()).pixels);
  }
}

TEST(Render, GivesTheBackgroundWhereThereIsNothingToDraw) {
  RenderOptions options = small_picture();
  options.background = {10, 20, 30};
  const Points none(0, 3);
  const Points one_place = Points::Constant(4, 3, 2.0);
  for (const Image& image :
       {render({none, Triangles(0, 3)}, options), render({one_place, two_triangles(0)}, options)}) {
    ASSERT_EQ(image.pixels.size(), 60U * 40U);
    EXPECT_EQ(pixels_unlike(image, {10, 20, 30}), 0U);
  }
}

TEST(Render, MeshesBesideEachOtherHaveOneScale) {
  const Points before = square_at(0.0, 1.0);
  const Points after = square_at(0.0, 0.5);
  const Triangles F = two_triangles(0);
  const std::array<PaintedMesh, 2> meshes{{{before, F}, {after, F}}};
  const Image image = render_side_by_side(meshes, straight_on(40));
  ASSERT_EQ(image.width, 80);
  ASSERT_EQ(image.height, 40);
  const Rgb white{255, 255, 255};
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 80; ++column) {
      const bool inside = column < 40 || (column >= 50 && column < 70 && row >= 10 && row < 30);
      EXPECT_EQ(image.at(column, row) != white, inside) << column << ' ' << row;
    }
  }
}

TEST(Render, FramesTheGivenPointsAndLeavesOutWhatHidesThem) {
  Points X(8, 3);
  X << square_at(0.0, 2.0), square_at(3.0, 2.0);
  Triangles F(4, 3);
  F << two_triangles(0), two_triangles(4);
  RenderOptions options = straight_on(40);
  options.frame.X = square_at(0.0, 1.0);
  const PaintedMesh hidden{X, F, {.marked_from = 2}}, alone{X, two_triangles(0)};
  options.frame.foreground = 0.5;
  EXPECT_EQ(render(hidden, options).pixels, render(alone, options).pixels);
  EXPECT_EQ(pixels_unlike(render(alone, options), {255, 255, 255}), 1600U);
  options.frame.X.row(0)[2] = 2;  // the points reach to 2, and the foreground to 2 + 1
  EXPECT_NE(render(hidden, options).pixels, render(alone, options).pixels);
}

TEST(Render, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<RenderOptions> bad{
      {.width = 0},
      {.height = 8193},
      {.samples = 0},
      {.samples = 5},
      {.view = {.from = {0.0, 0.0, 0.0}}},
      {.view = {.from = {nan, 0.0, 1.0}}},
      {.view = {.up = {nan, 0.0, 1.0}}},
      {.view = {.field_of_view = -0.1}},
      {.view = {.field_of_view = nan}},
      {.view = {.margin = 0.5}},
      {.frame = {.X = Points::Constant(1, 3, nan)}},
      {.frame = {.foreground = 1.5}},
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    EXPECT_THROW(render({square_at(0.0, 1.0), two_triangles(0)}, bad[i]), BadOption) << i;
  }
}

}  // namespace
}  // namespace ibmfair
