#include "ibmfair/picture/close_up.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/picture/visibility.h"

namespace ibmfair {
namespace {

constexpr double frame_radius = 2;  // in radii of the part
constexpr double least_edges = 4;   // the frame's radius is at least this many edge lengths
// Relative to the area. Parts with a shorter mean normal count as tubes.
constexpr double shortest_normal = 0.2;
constexpr int trial_size = 200;        // pixels
constexpr double least_visible = 0.6;  // of the part's pixels, or the foreground is cut away
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double shallow = 0.05;  // Frame::foreground then

/// The part that is looked at.
struct Part {
  Triangles F;
  Vec3 middle;  // of the bounding box
  double radius;
  double edge_length;  // mean

  Part(const Points& X, Triangles triangles) : F(std::move(triangles)) {
    const Points corners = X(F.reshaped(), Eigen::all);
    middle = (corners.colwise().minCoeff() + corners.colwise().maxCoeff()).transpose() / 2;
    radius = (corners.rowwise() - middle.transpose()).rowwise().norm().maxCoeff();
    edge_length = 0;
    for (const auto x : F.rowwise()) {
      for (int i = 0; i < 3; ++i) {
        edge_length += (X.row(x[i]) - X.row(x[(i + 1) % 3])).norm();
      }
    }
    edge_length /= static_cast<double>(F.size());
    corners_ = corners.rowwise() - middle.transpose();
  }

  /// How far the part reaches from its middle in a direction, length.
  double nearest(const Vec3& direction) const { return (corners_ * direction).maxCoeff(); }

 private:
  Points corners_;  // relative to the middle
};

/// Whether the part lies in a closed component that is oriented inward.
bool is_inside_out(const Points& X, const Topology& topology, const Part& part) {
  const Index component = topology.component[part.F(0, 0)];
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    if (topology.component[loop.vertices.front()] == component) {
      return false;
    }
  }
  double volume = 0;  // times 6, signed
  for (const auto x : topology.F.rowwise()) {
    if (topology.component[x[0]] == component) {
      const Vec3 a = X.row(x[0]).transpose() - part.middle;
      const Vec3 b = X.row(x[1]).transpose() - part.middle;
      const Vec3 c = X.row(x[2]).transpose() - part.middle;
      volume += a.dot(b.cross(c));
    }
  }
  return volume < 0;
}

/// The mean normal of the part; of a tube, the mean normal of the half that faces `preferred`.
Vec3 direction_of(const Points& X, const Part& part, double side, const Vec3& preferred) {
  Vec3 sum = Vec3::Zero(), facing = Vec3::Zero();
  double area = 0;
  for (Eigen::Index t = 0; t < part.F.rows(); ++t) {
    const Vec3 normal = side * double_area_vector(X, part.F, t);
    sum += normal;
    area += normal.norm();
    facing += normal.dot(preferred) > 0 ? normal : Vec3(Vec3::Zero());
  }
  return sum.norm() > shortest_normal * area ? sum : facing;
}

/// The vertices of the mesh around the part that do not lie more than `in_front` (length) before
/// the middle of the part, seen from `direction` (a unit vector).
Points vertices_around(const Points& X, const Part& part, const Vec3& direction, double in_front) {
  const double radius = std::max(frame_radius * part.radius, least_edges * part.edge_length);
  std::vector<Index> inside;
  for (Index v = 0; v < X.rows(); ++v) {
    const Vec3 offset = X.row(v).transpose() - part.middle;
    if (offset.norm() <= radius && offset.dot(direction) <= in_front) {
      inside.push_back(v);
    }
  }
  return X(inside, Eigen::all);
}

/// The number of pixels of a small picture that show one of the triangles.
std::int64_t visible_pixels(const Points& X, const Triangles& F, Index first, Index count,
                            const RenderOptions& options) {
  const Camera camera(options.view, trial_size, trial_size, options.frame.X);
  const Visibility seen = find_visible(X, F, camera, trial_size, trial_size);
  return std::ranges::count_if(seen.triangle,
                               [&](Index t) { return t >= first && t < first + count; });
}

/// Whether the rest of the mesh hides most of the part.
bool is_hidden(const Points& X, const Triangles& F, Index first, Index count,
               const RenderOptions& options) {
  const Triangles drawn = without_foreground(X, F, options.view, options.frame);
  Triangles alone = Triangles::Zero(F.rows(), 3);
  alone.middleRows(first, count) = F.middleRows(first, count);
  return static_cast<double>(visible_pixels(X, drawn, first, count, options)) <
         least_visible * static_cast<double>(visible_pixels(X, alone, first, count, options));
}

}  // namespace

RenderOptions close_up(const Points& X, const Topology& topology, Index first, Index count,
                       RenderOptions options) {
  if (count == 0) {
    return options;
  }
  const Part part(X, topology.F.middleRows(first, count));
  const double side = is_inside_out(X, topology, part) ? -1 : 1;
  const Vec3 direction = direction_of(X, part, side, options.view.from);
  if (!direction.allFinite() || !(direction.norm() > 0)) {
    return options;
  }
  options.view.from = direction.stableNormalized();
  options.frame.X = vertices_around(X, part, options.view.from, endless);
  if (is_hidden(X, topology.F, first, count, options)) {
    options.frame.X = vertices_around(X, part, options.view.from, part.nearest(options.view.from));
    options.frame.foreground = shallow;
  }
  return options;
}

}  // namespace ibmfair
