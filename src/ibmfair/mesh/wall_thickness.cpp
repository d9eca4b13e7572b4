#include "ibmfair/mesh/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/box_grid.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The cosine between the normals of a triangle and of the triangle on the other side of a wall, at
/// most. The sides of a wedge of 70 degrees have it; at a rim, averaged normals are tilted as much.
constexpr double facing = -0.3;

/// The averaged normal of triangle t.
Vec3 mean_normal(const Points& area_vectors, const Topology& topology, Index t) {
  const auto corners = topology.F.row(t);
  return (area_vectors.row(corners[0]) + area_vectors.row(corners[1]) +
          area_vectors.row(corners[2]))
      .transpose()
      .stableNormalized();
}

Vec3 centroid(const Points& X, const Topology& topology, Index t) {
  const auto corners = topology.F.row(t);
  return (X.row(corners[0]) + X.row(corners[1]) + X.row(corners[2])) / 3;
}

/// A ray from a triangle into the solid, as long as the thickest wall.
struct Ray {
  Index position = -1;  // of the triangle in the list of those whose walls are asked for
  Vec3 start = Vec3::Zero(), direction = Vec3::Zero();  // of unit length, or zero if there is none
};

/// Where a ray meets a triangle.
struct Meeting {
  Index ray = -1, triangle = -1;
  double distance = std::numeric_limits<double>::infinity(), u = 0, v = 0;
};

/// Where the ray meets triangle (a,b,c), at an infinite distance if it does not [T. Moeller, B.
/// Trumbore, "Fast, minimum storage ray-triangle intersection", J. Graphics Tools 2 (1997)].
Meeting meeting_of(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double rim = -1e-9;  // a ray through an edge meets one of its triangles at least
  const Vec3 ab = b - a, ac = c - a, from = ray.start - a;
  const Vec3 p = ray.direction.cross(ac), q = from.cross(ab);
  const double det = ab.dot(p), u = from.dot(p) / det, v = ray.direction.dot(q) / det;
  const double distance = ac.dot(q) / det;
  Meeting meeting;
  if (u >= rim && v >= rim && u + v <= 1 - rim && distance >= 0) {
    meeting.distance = distance;
    meeting.u = u;
    meeting.v = v;
  }
  return meeting;
}

class WallFinder {
 public:
  WallFinder(const Points& X, const Topology& topology, const std::vector<Index>& triangles,
             double thickest)
      : X_(X),
        topology_(topology),
        triangles_(triangles),
        thickest_(thickest),
        area_vectors_(vertex_area_vectors(X, topology)) {}

  std::vector<Wall> find() {
    std::vector<Wall> walls(triangles_.size());
    cast_rays();
    if (rays_.empty()) {
      return walls;
    }
    const BoxGrid grid(boxes_of_rays());
    constexpr std::int64_t block = 4096;
    const std::int64_t count = topology_.F.rows();
    std::vector<std::vector<Meeting>> meetings((count + block - 1) / block);
    run_tasks(std::ssize(meetings), count >= worth_sharing, [&](std::int64_t i) {
      meet(grid, i * block, std::min(count, (i + 1) * block), meetings[i]);
    });
    for (const auto& some : meetings) {
      for (const Meeting& meeting : some) {
        if (Wall& wall = walls[rays_[meeting.ray].position]; meeting.distance < wall.thickness) {
          wall = {meeting.distance, meeting.triangle,
                  Vec3(1 - meeting.u - meeting.v, meeting.u, meeting.v)};
        }
      }
    }
    return walls;
  }

 private:
  /// From the triangles of closed components. Empty boxes of other rays would make the cells of the
  /// grid tiny.
  void cast_rays() {
    const std::vector<int> sign = outward_signs(X_, topology_);
    const auto sign_at = [&](Index t) {
      const Index component = topology_.component[topology_.F(t, 0)];
      return component < 0 ? 0 : sign[component];
    };
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (sign_at(triangles_[i]) != 0) {
        rays_.emplace_back().position = static_cast<Index>(i);
      }
    }
    parallel_for(std::ssize(rays_), [&](std::int64_t i) {
      const Index t = triangles_[rays_[i].position];
      rays_[i].start = centroid(X_, topology_, t);
      rays_[i].direction = -sign_at(t) * mean_normal(area_vectors_, topology_, t);
    });
  }

  std::vector<BoxGrid::Box> boxes_of_rays() const {
    std::vector<BoxGrid::Box> boxes(rays_.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      boxes[i].extend(rays_[i].start);
      boxes[i].extend(rays_[i].start + thickest_ * rays_[i].direction);
    }
    return boxes;
  }

  /// Finds the rays that meet the triangles first .. last - 1.
  void meet(const BoxGrid& grid, std::int64_t first, std::int64_t last,
            std::vector<Meeting>& meetings) const {
    std::vector<Index> found;
    for (auto t = static_cast<Index>(first); t < last; ++t) {
      if (!topology_.usable[t]) {
        continue;
      }
      const Vec3 a = X_.row(topology_.F(t, 0)), b = X_.row(topology_.F(t, 1)),
                 c = X_.row(topology_.F(t, 2));
      grid.find(BoxGrid::Box(a).extend(b).extend(c), found);
      for (const Index i : found) {
        if (start_of(i) == t || rays_[i].direction.isZero() || !faces_against(i, t)) {
          continue;
        }
        Meeting meeting = meeting_of(rays_[i], a, b, c);
        if (meeting.distance <= thickest_) {
          meeting.ray = i;
          meeting.triangle = t;
          meetings.push_back(meeting);
        }
      }
    }
  }

  /// Whether triangle t faces the way that ray i goes, as the other side of a wall does.
  bool faces_against(Index i, Index t) const {
    const Index component = topology_.component[topology_.F(t, 0)];
    return component == topology_.component[topology_.F(start_of(i), 0)] &&
           mean_normal(area_vectors_, topology_, t)
                   .dot(mean_normal(area_vectors_, topology_, start_of(i))) < facing;
  }

  /// The triangle from which ray i starts.
  Index start_of(Index i) const { return triangles_[rays_[i].position]; }

  const Points& X_;
  const Topology& topology_;
  const std::vector<Index>& triangles_;
  const double thickest_;
  const Points area_vectors_;
  std::vector<Ray> rays_;
};

}  // namespace

std::vector<int> outward_signs(const Points& X, const Topology& topology) {
  const auto count = static_cast<std::size_t>(topology.component_count);
  std::vector<double> volume(count, 0);
  std::vector<Index> first(count, -1);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    const Index v = topology.F(t, 0), c = topology.component[v];
    if (c < 0) {
      continue;
    }
    first[c] = first[c] < 0 ? v : first[c];
    volume[c] += (X.row(v) - X.row(first[c])).dot(double_area_vector(X, topology.F, t));
  }
  std::vector<int> sign(count, 0);
  for (std::size_t c = 0; topology.orientable && c < count; ++c) {
    sign[c] = volume[c] > 0 ? 1 : volume[c] < 0 ? -1 : 0;
  }
  for (const BoundaryLoop& loop : topology.boundary_loops) {
    sign[topology.component[loop.vertices.front()]] = 0;
  }
  return sign;
}

Points vertex_area_vectors(const Points& X, const Topology& topology) {
  Points sums(X.rows(), 3);
  parallel_for(X.rows(), [&](std::int64_t v) {
    sums.row(v) = double_area_vector_at(static_cast<Index>(v), X, topology);
  });
  return sums;
}

double thickness_at(const Points& Y, const Points& area_vectors, const Topology& topology, Index t,
                    const Wall& wall, int outward) {
  const auto corners = topology.F.row(wall.opposite);
  Vec3 there = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    there += wall.weights[i] * Y.row(corners[i]);
  }
  return outward * mean_normal(area_vectors, topology, t).dot(centroid(Y, topology, t) - there);
}

std::vector<Wall> find_walls(const Points& X, const Topology& topology,
                             const std::vector<Index>& triangles, double thickest) {
  return WallFinder(X, topology, triangles, thickest).find();
}

}  // namespace ibmfair
