// The picture that `ibmfair fill --picture` draws looks at the largest patch.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/shapes/shapes.h"
#include "support/files.h"
#include "support/holed_meshes.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

struct Pixel {
  int red, green, blue;

  bool operator==(const Pixel&) const = default;
  /// The colour of patches, however it is lit: brighter than the reddish colour of back faces.
  bool shows_patch() const { return blue < 0.62 * red && green > 0.71 * red; }
};

/// The two halves of a picture: before and after.
struct Picture {
  int width = 0, height = 0;  // of a half
  std::vector<Pixel> before, after;

  double patch_share(const std::vector<Pixel>& half) const {
    std::int64_t count = 0;
    for (const Pixel& pixel : half) {
      count += pixel.shows_patch() ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(half.size());
  }

  /// The share of the pixels that changed although they show no patch afterwards.
  double other_changes() const {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      count += !after[i].shows_patch() && before[i] != after[i] ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(after.size());
  }
};

Picture read_picture(const std::string& path) {
  const std::string bytes = read_bytes(path);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0) << path;
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> raw(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, raw.data(), 0, nullptr), 0) << path;
  Picture picture;
  picture.width = static_cast<int>(header.width) / 2;
  picture.height = static_cast<int>(header.height);
  for (std::size_t i = 0; i + 2 < raw.size(); i += 3) {
    const bool left = i / 3 % header.width < header.width / 2;
    (left ? picture.before : picture.after).push_back({raw[i], raw[i + 1], raw[i + 2]});
  }
  return picture;
}

class FillPicture : public testing::Test {
 protected:
  Picture picture_of(const Mesh& mesh, const std::vector<std::string>& options = {}) {
    const std::string in = directory_ / fmt::format("in{}.off", inputs_++);
    write_mesh(mesh, in);
    std::vector<std::string> arguments{
        "fill", in, directory_ / "out.off", "--picture", directory_ / "out.png", "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const RunResult run = run_program(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_picture(directory_ / "out.png");
  }

  void expect_close_up(const Mesh& mesh) {
    const Picture picture = picture_of(mesh);
    EXPECT_GT(picture.patch_share(picture.after), 0.06);
    EXPECT_LT(picture.patch_share(picture.before), 1e-4);  // single mixed pixels
    EXPECT_LT(picture.other_changes(), 0.02);              // the dark lines along the rim
  }

  TemporaryDirectory directory_;
  int inputs_ = 0;
};

/// The torus without the triangles near the direction `angle` of its cross section; 0 is outermost.
Mesh torus_with_hole(double angle) {
  const Mesh torus = make_shape("torus", {.columns = 80});
  const double r = 1 / std::sqrt(2.0);
  const Vec3 middle(1 + r * std::cos(angle), 0, r * std::sin(angle));
  std::vector<Index> cut;
  for (Index f = 0; f < torus.faces.size(); ++f) {
    if ((torus.X.row(torus.faces[f][0]).transpose() - middle).norm() < 0.2) {
      cut.push_back(f);
    }
  }
  return without_triangles(torus, cut);
}

TEST_F(FillPicture, LooksStraightOntoThePatchWhereverItIs) {
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    const double scale = i == 4 ? 1e-8 : i == 5 ? 1e8 : 1;
    expect_close_up(moved(without_cap(sphere(4), 15), scale, scale * Vec3(3, -1, 2), i));
  }
}

TEST_F(FillPicture, LooksThroughWhatHidesThePatch) {
  for (const double angle : {0.0, 1.0, 2.0, 3.1}) {
    SCOPED_TRACE(angle);
    expect_close_up(torus_with_hole(angle));
  }
}

TEST_F(FillPicture, LooksFromOutsideIfTrianglesAreOrientedInward) {
  const Mesh mesh = without_cap(sphere(4), 15);
  Mesh reversed = mesh;
  reversed.faces = {};
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto x = mesh.faces[f];
    reversed.faces.add(std::vector<Index>{x[0], x[2], x[1]});
  }
  const Picture one = picture_of(mesh), other = picture_of(reversed);
  EXPECT_NEAR(one.patch_share(one.after), other.patch_share(other.after), 0.01);
  expect_close_up(reversed);
}

TEST_F(FillPicture, ChoosesTheLargestOfSeveralPatches) {
  const Mesh ball = without_cap(sphere(4), 25);
  const Picture one = picture_of(ball);
  std::vector<Index> far;  // a small hole on the other side
  for (Index f = 0; f < ball.faces.size() && far.empty(); ++f) {
    if (ball.X.row(ball.faces[f][0]).dot(Eigen::RowVector3d(0.3, 0.5, 0.81)) < -0.98) {
      far.push_back(f);
    }
  }
  ASSERT_FALSE(far.empty());
  const Picture two = picture_of(without_triangles(ball, far));
  EXPECT_TRUE(one.after == two.after);
}

TEST_F(FillPicture, ShowsTheWholeMeshIfNothingIsFilled) {
  const Picture picture = picture_of(sphere(3));
  EXPECT_TRUE(picture.before == picture.after);
  EXPECT_EQ(picture.patch_share(picture.after), 0);
  EXPECT_EQ(picture.before.front(), (Pixel{255, 255, 255}));
}

TEST_F(FillPicture, QuantitiesAreSeenFromTheSamePlace) {
  const Mesh mesh = without_cap(sphere(4), 15);
  const Picture plain = picture_of(mesh),
                field = picture_of(mesh, {"--picture-colour", "triangle_quality"});
  std::int64_t background = 0, same = 0;
  for (std::size_t i = 0; i < plain.after.size(); ++i) {
    const Pixel white{255, 255, 255};
    background += plain.after[i] == white ? 1 : 0;
    same += plain.after[i] == white && field.after[i] == white ? 1 : 0;
  }
  EXPECT_EQ(plain.width, field.width);
  EXPECT_EQ(background, same);
}

}  // namespace
}  // namespace ibmfair::test
