#include "ibmfair/picture/render.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "ibmfair/base/errors.h"
#include "ibmfair/picture/visibility.h"

namespace ibmfair {
namespace {

constexpr Rgb line_colour{40, 40, 48};
constexpr double line_width = 0.8;     // pixels
constexpr double hiding_depth = 0.02;  // of the shorter side; smaller jumps are relief

/// The corners of the triangles that can be drawn, one per row; the picture must contain all of
/// them.
Points drawn_corners(const Points& X, const Triangles& F) {
  Points corners(3 * F.rows(), 3);
  Eigen::Index count = 0;
  for (const auto& triangle : F.rowwise()) {
    if (X(triangle, Eigen::all).allFinite()) {
      corners.middleRows<3>(count) = X(triangle, Eigen::all);
      count += 3;
    }
  }
  corners.conservativeResize(count, 3);
  return corners;
}

/// Finds the pixels of the frontmost surface next to background or to a surface far behind it.
class Silhouette {
 public:
  Silhouette(const Visibility& seen, int samples)
      : seen_(seen),
        reach_(std::max(1, static_cast<int>(std::lround(line_width * samples)))),
        jump_(hiding_depth * std::min(seen.width, seen.height)) {}

  bool passes(int column, int row) const {
    return ends_between(column, row, reach_, 0) || ends_between(column, row, 0, reach_);
  }

 private:
  bool ends_between(int column, int row, int right, int down) const {
    const double here = nearness(column, row);
    const double one = nearness(column - right, row - down);
    const double other = nearness(column + right, row + down);
    // On a slope, the nearness falls on one side as much as it rises on the other; only a jump
    // counts.
    return 2.0 * here - one - other > jump_ && here > std::min(one, other) + jump_;
  }

  double nearness(int column, int row) const {
    const int x = std::clamp(column, 0, seen_.width - 1);
    const int y = std::clamp(row, 0, seen_.height - 1);
    return seen_.nearness[seen_.pixel(x, y)];
  }

  const Visibility& seen_;
  int reach_;
  double jump_;
};

/// Averages blocks of samples x samples.
Image develop(const Visibility& seen, const std::vector<Light>& triangle_light,
              const RenderOptions& options) {
  const Silhouette silhouette(seen, options.samples);
  const Light background = light_of(options.background);
  const Light line = light_of(line_colour);
  const auto sample = [&](int column, int row) -> const Light& {
    const Index t = seen.triangle[seen.pixel(column, row)];
    if (t == Visibility::nothing) {
      return background;
    }
    const bool on_line = options.silhouettes && silhouette.passes(column, row);
    return on_line ? line : triangle_light[t];
  };

  Image image(options.width, options.height);
  const int n = options.samples;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      Light sum = Light::Zero();
      for (int k = 0; k < n * n; ++k) {
        sum += sample(n * column + k % n, n * row + k / n);
      }
      image.at(column, row) = colour_of(sum / static_cast<float>(n * n));
    }
  }
  return image;
}

/// Takes pictures with one camera. The first picture determines which side of the triangles is the
/// front.
class Studio {
 public:
  /// `in_view`: the points that the pictures must contain.
  Studio(const Points& in_view, const RenderOptions& options)
      : options_(options),
        width_(options.samples * options.width),
        height_(options.samples * options.height),
        camera_(options.view, width_, height_, in_view) {}

  Image take(const PaintedMesh& mesh) {
    const Triangles F = without_foreground(mesh.X, mesh.F, options_.view, options_.frame);
    const Visibility seen = find_visible(mesh.X, F, camera_, width_, height_);
    if (!front_is_anticlockwise_) {
      front_is_anticlockwise_ = shows_anticlockwise_sides(mesh.X, F, camera_, seen);
    }
    return develop(seen,
                   shade_triangles(mesh.X, F, camera_, seen, mesh.paint, *front_is_anticlockwise_),
                   options_);
  }

 private:
  const RenderOptions& options_;
  int width_, height_;  // samples
  Camera camera_;
  std::optional<bool> front_is_anticlockwise_;
};

void validate(const PaintedMesh& mesh) {
  const std::size_t colours = mesh.paint.triangle.size();
  if (colours != 0 && colours != static_cast<std::size_t>(mesh.F.rows())) {
    throw BadOption("a picture needs one colour per triangle, or none");
  }
}

std::vector<Image> render_all(std::span<const PaintedMesh> meshes, const RenderOptions& options) {
  options.validate();
  Points in_view = options.frame.X;
  for (const PaintedMesh& mesh : meshes) {
    validate(mesh);
    if (options.frame.X.rows() == 0) {
      const Points corners = drawn_corners(mesh.X, mesh.F);
      in_view.conservativeResize(in_view.rows() + corners.rows(), 3);
      in_view.bottomRows(corners.rows()) = corners;
    }
  }
  Studio studio(in_view, options);
  std::vector<Image> images(meshes.size());
  for (std::size_t i = meshes.size(); i-- > 0;) {
    images[i] = studio.take(meshes[i]);
  }
  return images;
}

}  // namespace

void RenderOptions::validate() const {
  if (width < 1 || width > 8192 || height < 1 || height > 8192) {
    throw BadOption("a picture's width and height must be between 1 and 8192 pixels");
  }
  if (samples < 1 || samples > 4) {
    throw BadOption("a picture takes 1 to 4 samples per pixel and direction");
  }
  view.validate();
  if (!frame.X.allFinite() || !(frame.foreground >= 0 && frame.foreground <= 1)) {
    throw BadOption("the points of a frame must be finite, and its foreground between 0 and 1");
  }
}

Image render(const PaintedMesh& mesh, const RenderOptions& options) {
  return render_all({&mesh, 1}, options).front();
}

Image render_side_by_side(std::span<const PaintedMesh> meshes, const RenderOptions& options) {
  const std::vector<Image> images = render_all(meshes, options);
  const double margin = options.view.margin * std::min(options.width, options.height);
  return without_empty_rows(side_by_side(images, 0, options.background), options.background,
                            static_cast<int>(std::lround(margin)));
}

}  // namespace ibmfair
