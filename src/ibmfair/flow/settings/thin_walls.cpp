#include "ibmfair/flow/settings/thin_walls.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ibmfair/base/quantile.h"
#include "ibmfair/flow/settings/rim_paths.h"
#include "ibmfair/flow/tuning.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

double area_of(Index t, const Points& X, const Topology& topology) {
  return double_area_vector(X, topology.F, t).norm() / 2;
}

double mean_edge_of(Index t, const Points& X, const Topology& topology) {
  const auto corners = topology.F.row(t);
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += (X.row(corners[i]) - X.row(corners[(i + 1) % 3])).norm();
  }
  return sum / 3;
}

/// The sum over the corners of t.
template <class Values>
double at_corners(const Values& values, Index t, const Topology& topology) {
  const auto corners = topology.F.row(t);
  return values[corners[0]] + values[corners[1]] + values[corners[2]];
}

/// A value for each vertex: the sum over its triangles.
template <class Value>
Eigen::VectorXd around_vertices(const Topology& topology, const Value& of_triangle) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(topology.vertex_count);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    const double value = of_triangle(t);
    for (const Index v : topology.F.row(t)) {
      sums[v] += value;
    }
  }
  return sums;
}

/// How much the triangles around the corners of t face the same way: the length of the sum of their
/// area vectors over the sum of the lengths.
double coherence(Index t, const Points& area_vectors, const Eigen::VectorXd& lengths,
                 const Topology& topology) {
  const auto corners = topology.F.row(t);
  const Vec3 sum =
      area_vectors.row(corners[0]) + area_vectors.row(corners[1]) + area_vectors.row(corners[2]);
  const double all = at_corners(lengths, t, topology);
  return all > 0 ? sum.norm() / all : 0;
}

double thickest_wall(const Points& X, const Topology& topology, double cutoff) {
  return std::min(tuning.thin_walls.edges * mean_edge_length(X, topology.E),
                  tuning.thin_walls.of_cutoff * cutoff);
}

/// The components that are thin walls, as flags. A body that is hardly longer than thick, of a few
/// large triangles, is none.
std::vector<std::uint8_t> thin_components(const Points& X, const Topology& topology,
                                          const WallSample& sample) {
  const auto count = static_cast<std::size_t>(topology.component_count);
  std::vector<double> area(count, 0), sampled(count, 0), thin(count, 0);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    if (const Index c = topology.component[topology.F(t, 0)]; c >= 0) {
      area[c] += area_of(t, X, topology);
    }
  }
  for (std::size_t i = 0; i < sample.triangles.size(); ++i) {
    const Index t = sample.triangles[i], c = topology.component[topology.F(t, 0)];
    if (c >= 0) {
      const double size = tuning.thin_walls.of_size * std::sqrt(area[c]);
      sampled[c] += area_of(t, X, topology);
      thin[c] += sample.walls[i].thickness < size ? area_of(t, X, topology) : 0;
    }
  }
  std::vector<std::uint8_t> result(count, 0);
  for (std::size_t c = 0; c < count; ++c) {
    result[c] = thin[c] > tuning.thin_walls.share * sampled[c] ? 1 : 0;
  }
  return result;
}

/// Flags the vertices between the two sides of each wall where a short path leads from one side to
/// the other.
std::vector<std::uint8_t> rims_of(const std::vector<Wall>& walls, const Points& X,
                                  const Topology& topology) {
  std::vector<std::uint8_t> rims(static_cast<std::size_t>(topology.vertex_count), 0);
  const CompressedRows rings = vertex_rings(topology);
  RimPaths paths(X, topology, rings);
  const auto area = [&](Index t) { return area_of(t, X, topology); };
  const Eigen::VectorXd all = around_vertices(topology, area);
  const Eigen::VectorXd walled =
      around_vertices(topology, [&](Index t) { return walls[t].exists() ? area(t) : 0; });
  for (Index t = 0; t < topology.F.rows(); ++t) {
    if (!walls[t].exists() || at_corners(walled, t, topology) <
                                  tuning.thin_walls.share_around * at_corners(all, t, topology)) {
      continue;
    }
    const double longest = tuning.thin_walls.path * walls[t].thickness +
                           tuning.thin_walls.beyond * mean_edge_of(t, X, topology);
    const std::vector<Index> path = paths.find(t, walls[t].opposite, longest);
    for (const Index v : path) {
      rims[v] = 1;
    }
    for (int i = 0; !path.empty() && i < 3; ++i) {
      rims[topology.F(t, i)] = rims[topology.F(walls[t].opposite, i)] = 1;
    }
  }
  return rims;
}

}  // namespace

WallSample sample_walls(const Points& X, const Topology& topology, double cutoff) {
  WallSample sample;
  const Index stride = 1 + topology.F.rows() / tuning.thin_walls.sample;
  for (Index t = 0; t < topology.F.rows(); t += stride) {
    sample.triangles.push_back(t);
  }
  sample.walls = find_walls(X, topology, sample.triangles, thickest_wall(X, topology, cutoff));
  const Points area_vectors = vertex_area_vectors(X, topology);
  const Eigen::VectorXd lengths =
      around_vertices(topology, [&](Index t) { return 2 * area_of(t, X, topology); });
  for (std::size_t i = 0; i < sample.walls.size(); ++i) {
    if (sample.walls[i].exists() && coherence(sample.triangles[i], area_vectors, lengths,
                                              topology) < tuning.thin_walls.coherence) {
      sample.walls[i] = {};
    }
  }
  return sample;
}

double median_thickening(const Points& X, const Points& Y, const Topology& topology,
                         const WallSample& sample) {
  constexpr double least_share = 0.01;
  const std::vector<int> outward = outward_signs(X, topology);
  const Points area_vectors = vertex_area_vectors(Y, topology);
  std::vector<double> ratios;
  double walled = 0, all = 0;
  for (std::size_t i = 0; i < sample.triangles.size(); ++i) {
    const Index t = sample.triangles[i];
    const Wall& wall = sample.walls[i];
    all += area_of(t, X, topology);
    if (wall.exists() && wall.thickness > 0) {
      walled += area_of(t, X, topology);
      ratios.push_back(thickness_at(Y, area_vectors, topology, t, wall,
                                    outward[topology.component[topology.F(t, 0)]]) /
                       wall.thickness);
    }
  }
  if (!(walled > least_share * all)) {
    return 1;
  }
  return median(ratios);
}

ThinWalls thin_walls(const Points& X, const Topology& topology, const WallSample& sample) {
  ThinWalls result;
  const std::vector<std::uint8_t> thin = thin_components(X, topology, sample);
  if (std::ranges::find(thin, 1) == thin.end()) {
    return result;
  }
  double thickest = 0;
  for (const Wall& wall : sample.walls) {
    thickest = wall.exists() ? std::max(thickest, wall.thickness) : thickest;
  }
  std::vector<Index> triangles;
  for (Index t = 0; t < topology.F.rows(); ++t) {
    const Index c = topology.component[topology.F(t, 0)];
    if (c >= 0 && thin[c]) {
      triangles.push_back(t);
    }
  }
  const std::vector<Wall> found = find_walls(X, topology, triangles, thickest);
  result.walls.resize(static_cast<std::size_t>(topology.F.rows()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    result.walls[triangles[i]] = found[i];
  }
  result.rims = rims_of(result.walls, X, topology);
  return result;
}

}  // namespace ibmfair
