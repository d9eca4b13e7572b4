#include "ibmfair/solve/separator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// The directions from the centre of a cube to its faces, edges and corners, up to sign; zeros fill
/// the remaining lanes.
constexpr int directions = 13, lanes = 16;
constexpr float direction[3][lanes] = {{1, 0, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, -1},   //
                                       {0, 1, 0, 1, -1, 0, 0, 1, 1, 1, 1, -1, 1},  //
                                       {0, 0, 1, 0, 0, 1, -1, 1, -1, 1, -1, 1, 1}};

/// Positions relative to the first node, in units of the size of their bounding box.
using Places = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The extent of a node in each direction: the inner product of its position with the direction.
using Extents = Eigen::Array<float, lanes, 1>;

Extents extents(const Places& places, Eigen::Index v) {
  const Eigen::Map<const Eigen::Matrix<float, lanes, 3>> D(direction[0]);
  return D * places.row(v).transpose();
}

/// The range of extents in which planes are tried.
struct Range {
  Extents low = Extents::Constant(std::numeric_limits<float>::infinity());
  Extents high = -low;
};

/// The whole range of extents if there are few nodes. If there are many, the middle range of a
/// sample, so that a few distant nodes do not leave all others in a single step.
Range range_of(const Places& places) {
  constexpr Eigen::Index few = 4096, sampled = 256, outside = sampled / 10;
  Range range;
  if (places.rows() < few) {
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
      const Extents extent = extents(places, v);
      range.low = range.low.min(extent);
      range.high = range.high.max(extent);
    }
    return range;
  }
  Eigen::Array<float, sampled, lanes> sample;
  for (Eigen::Index i = 0; i < sampled; ++i) {
    sample.row(i) = extents(places, i * places.rows() / sampled).transpose();
  }
  for (int d = 0; d < lanes; ++d) {
    auto column = sample.col(d);
    std::sort(column.begin(), column.end());
    range.low[d] = column[outside];
    range.high[d] = column[sampled - 1 - outside];
  }
  return range;
}

/// The extents of a node, rounded down to whole steps; the range has `steps` steps.
constexpr int steps = 128;
using Heights [[gnu::vector_size(lanes)]] = std::uint8_t;

std::vector<Heights> heights_of(const Places& places) {
  const Range range = range_of(places);
  const Extents width = range.high - range.low;
  const Extents steps_a_length = (width > 0).select((steps - 1) / width, 0);
  std::vector<Heights> heights(static_cast<std::size_t>(places.rows()));
  for (Eigen::Index v = 0; v < places.rows(); ++v) {
    const Extents height =
        ((extents(places, v) - range.low) * steps_a_length).max(0).min(steps - 1);
    for (int d = 0; d < lanes; ++d) {
      heights[v][d] = static_cast<std::uint8_t>(height[d]);
    }
  }
  return heights;
}

/// The lowest heights of a node and its neighbours in the graph.
Heights lowest_around(const CompressedRows& graph, const std::vector<Heights>& heights, Index v) {
  Heights lowest = heights[v];
  for (const Index w : graph[v]) {
    lowest = heights[w] < lowest ? heights[w] : lowest;
  }
  return lowest;
}

/// Nodes with a height below `height` lie below the plane.
struct Plane {
  int direction = 0;
  int height = 0;  ///< 0: there is none
};

/// The best plane, for separators above the plane.
Plane best_plane(const CompressedRows& graph, const std::vector<Heights>& heights) {
  constexpr double smallest_share = 0.2;
  // The increase in the number of nodes from the plane one step lower to this one.
  using Increases = Index[directions][steps + 1];
  Increases below{}, separating{};
  for (Index v = 0; v < graph.size(); ++v) {
    const Heights own = heights[v], lowest = lowest_around(graph, heights, v);
    for (int d = 0; d < directions; ++d) {
      ++below[d][own[d] + 1];
      ++separating[d][lowest[d] + 1];
      --separating[d][own[d] + 1];
    }
  }
  const double n = graph.size();
  Plane best;
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < directions; ++d) {
    double side = 0, separator = 0;
    for (int height = 1; height < steps; ++height) {
      side += below[d][height];
      separator += separating[d][height];
      const double smaller_side = std::min(side, n - side - separator);
      if (smaller_side < smallest_share * n) continue;
      // The separators of surfaces grow as the square root of the number of nodes that they
      // separate.
      const double cost = separator / std::sqrt(smaller_side);
      if (cost < least) {
        least = cost;
        best = {d, height};
      }
    }
  }
  return best;
}

}  // namespace

std::optional<Separation> separate(const CompressedRows& graph, const Points& X) {
  if (X.rows() == 0) return std::nullopt;
  const Places places = ((X.rowwise() - X.row(0)) / bounding_box_size(X).maxCoeff()).cast<float>();
  if (!places.allFinite()) return std::nullopt;
  const std::vector<Heights> heights = heights_of(places);
  const Plane plane = best_plane(graph, heights);
  if (plane.height == 0) return std::nullopt;
  const auto is_below = [&](Index v) { return heights[v][plane.direction] < plane.height; };
  Separation parts;
  for (Index v = 0; v < graph.size(); ++v) {
    if (is_below(v)) {
      parts.side[0].push_back(v);
    } else {
      const auto around = graph[v];
      const bool separates = std::any_of(around.begin(), around.end(), is_below);
      (separates ? parts.separator : parts.side[1]).push_back(v);
    }
  }
  return parts;
}

}  // namespace ibmfair
