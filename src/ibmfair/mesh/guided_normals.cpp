#include "ibmfair/mesh/guided_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Calls body(t) once for every triangle that shares a vertex with `triangle`, itself included.
template <class Body>
void for_patch(const Topology& topology, Index triangle, const Body& body) {
  const Triangles& F = topology.F;
  for (int corner = 0; corner < 3; ++corner) {
    for (const Index t : topology.stars[F(triangle, corner)]) {
      bool seen = false;
      for (int earlier = 0; earlier < corner; ++earlier) {
        seen |= (F.row(t).array() == F(triangle, earlier)).any();
      }
      if (!seen) {
        body(t);
      }
    }
  }
}

/// The triangles that share a vertex with each triangle, itself included.
CompressedRows patches_of_triangles(const Topology& topology) {
  const Index count = static_cast<Index>(topology.F.rows());
  CompressedRows patches;
  patches.first.assign(static_cast<std::size_t>(count) + 1, 0);
  parallel_for(count, [&](std::int64_t t) {
    for_patch(topology, static_cast<Index>(t), [&](Index) { ++patches.first[t + 1]; });
  });
  std::inclusive_scan(patches.first.begin(), patches.first.end(), patches.first.begin());
  patches.value.resize(static_cast<std::size_t>(patches.first.back()));
  parallel_for(count, [&](std::int64_t t) {
    Index* place = patches.value.data() + patches.first[t];
    for_patch(topology, static_cast<Index>(t), [&](Index other) { *place++ = other; });
  });
  return patches;
}

Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3::Zero();
}

/// How much the normals change across the hinges at the vertices and triangles of a mesh.
struct Changes {
  Eigen::VectorXd at_vertex, at_triangle;  // sums
  Eigen::VectorXd largest_at_vertex;
};

Changes changes_of(const Points& N, const Topology& topology) {
  Changes changes;
  changes.at_vertex = changes.largest_at_vertex = Eigen::VectorXd::Zero(topology.vertex_count);
  changes.at_triangle = Eigen::VectorXd::Zero(topology.F.rows());
  for (Eigen::Index h = 0; h < topology.H.rows(); ++h) {
    const auto triangles = topology.hinge_triangles.row(h);
    const double change = (N.row(triangles[0]) - N.row(triangles[1])).norm();
    for (const Index t : triangles) {
      changes.at_triangle[t] += change;
    }
    for (int end = 0; end < 2; ++end) {
      const Index v = topology.H(h, end);
      changes.at_vertex[v] += change;
      changes.largest_at_vertex[v] = std::max(changes.largest_at_vertex[v], change);
    }
  }
  return changes;
}

class GuidedFilter {
 public:
  GuidedFilter(const Points& X, const Topology& topology)
      : topology_(topology),
        patches_(patches_of_triangles(topology)),
        weight_(triangle_areas(X, topology.F)),
        normals_(triangle_normals(X, topology.F)),
        mean_(normals_),
        guide_(normals_),
        disorder_(normals_.rows()) {
    const double largest = weight_.size() > 0 ? weight_.maxCoeff() : 0;
    if (largest > 0) {
      weight_ /= largest;
    }
  }

  void sweep(double likeness) {
    const auto count = normals_.rows();
    parallel_for(count, [&](std::int64_t t) { take_mean(static_cast<Index>(t)); });
    measure_disorder();
    parallel_for(count, [&](std::int64_t t) { find_guide(static_cast<Index>(t)); });
    Points filtered(count, 3);
    parallel_for(count, [&](std::int64_t t) {
      Vec3 sum = Vec3::Zero();
      for (const Index other : patches_[static_cast<Index>(t)]) {
        const double difference = (guide_.row(t) - guide_.row(other)).squaredNorm();
        sum += weight_[other] * std::exp(-difference / (2 * likeness * likeness)) *
               normals_.row(other).transpose();
      }
      filtered.row(t) = unit(sum);
    });
    normals_ = std::move(filtered);
  }

  Points normals() && { return std::move(normals_); }

 private:
  void take_mean(Index t) {
    Vec3 sum = Vec3::Zero();
    for (const Index other : patches_[t]) {
      sum += weight_[other] * normals_.row(other).transpose();
    }
    mean_.row(t) = unit(sum);
  }

  /// The disorder of the patch around each triangle: the largest distance of a normal from the
  /// mean, times the share of the largest change across a hinge inside the patch in all changes
  /// there. The hinges inside are those at the corners of the triangle.
  void measure_disorder() {
    const Changes changes = changes_of(normals_, topology_);
    parallel_for(normals_.rows(), [&](std::int64_t t) {
      double squared_spread = 0;
      for (const Index other : patches_[static_cast<Index>(t)]) {
        squared_spread =
            std::max(squared_spread, (normals_.row(other) - mean_.row(t)).squaredNorm());
      }
      double all = -changes.at_triangle[t], largest = 0;  // its hinges are at two corners each
      for (const Index v : topology_.F.row(t)) {
        all += changes.at_vertex[v];
        largest = std::max(largest, changes.largest_at_vertex[v]);
      }
      disorder_[t] = largest > 0 ? std::sqrt(squared_spread) * largest / std::max(all, largest) : 0;
    });
  }

  void find_guide(Index t) {
    double least = std::numeric_limits<double>::infinity();
    for (const Index other : patches_[t]) {
      if (disorder_[other] < least) {
        least = disorder_[other];
        guide_.row(t) = mean_.row(other);
      }
    }
  }

  const Topology& topology_;
  const CompressedRows patches_;
  Eigen::VectorXd weight_;  // the areas, over the largest area
  Points normals_, mean_, guide_;
  Eigen::VectorXd disorder_;
};

}  // namespace

Points guided_normals(const Points& X, const Topology& topology, int sweeps, double likeness) {
  GuidedFilter filter(X, topology);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    filter.sweep(likeness);
  }
  return std::move(filter).normals();
}

Points fit_to_normals(const Points& X, const Topology& topology,
                      const std::vector<std::uint8_t>& fixed, const Points& normals, int sweeps) {
  Points fitted = X, previous, centroids(topology.F.rows(), 3);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    previous = fitted;
    parallel_for(centroids.rows(), [&](std::int64_t t) {
      centroids.row(t) = previous(topology.F.row(t), Eigen::all).colwise().mean();
    });
    parallel_for(X.rows(), [&](std::int64_t v) {
      const auto star = topology.stars[static_cast<Index>(v)];
      if (fixed[v] || star.empty()) {
        return;
      }
      const Vec3 x = previous.row(v);
      Vec3 move = Vec3::Zero();
      for (const Index t : star) {
        const Vec3 normal = normals.row(t);
        move += normal.dot(centroids.row(t).transpose() - x) * normal;
      }
      fitted.row(v) = x + move / static_cast<double>(star.size());
    });
  }
  return fitted;
}

}  // namespace ibmfair
