#include "ibmfair/measure/directed_distance.h"

#include <cmath>
#include <numeric>
#include <vector>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/measure/closest_point.h"
#include "ibmfair/measure/statistics.h"
#include "ibmfair/measure/used_vertices.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

namespace {

struct Samples {
  Points X;                     // #samples x 3
  std::vector<Index> triangle;  // #samples
};

Samples spread_over(const Points& X, const Triangles& F, std::int64_t count) {
  const Eigen::VectorXd area = triangle_areas(X, F);
  std::vector<double> up_to(static_cast<std::size_t>(area.size()));
  std::partial_sum(area.begin(), area.end(), up_to.begin());
  if (up_to.empty() || !(up_to.back() > 0.0 && std::isfinite(up_to.back()))) {
    throw BadMesh(
        "distances need a surface, but the triangles have no area together, or an infinite one");
  }
  constexpr std::uint64_t seed = 1;
  RandomNumbers random(seed);
  Samples samples{Points(count, 3), {}};
  std::size_t t = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    while (t + 1 < up_to.size() && up_to[t] <= at * up_to.back()) {
      ++t;
    }
    // The square root makes the point uniform over the triangle.
    const double s = std::sqrt(random.uniform());
    const double w = random.uniform();
    const auto f = static_cast<Eigen::Index>(t);
    samples.X.row(i) =
        (1.0 - s) * X.row(F(f, 0)) + s * (1.0 - w) * X.row(F(f, 1)) + s * w * X.row(F(f, 2));
    samples.triangle.push_back(static_cast<Index>(t));
  }
  return samples;
}

}  // namespace

DirectedDistance directed_distance(const Points& XA, const Triangles& FA, const Points& XB,
                                   const Triangles& FB, std::int64_t samples) {
  if (samples < 1) {
    throw BadOption("a distance between surfaces needs one sample at least");
  }
  const ClosestPoint closest(XB, FB);
  const Samples spread = spread_over(XA, FA, samples);
  const Points vertices = used_positions(XA, FA);
  const Points normals_a = triangle_normals(XA, FA);
  const Points normals_b = triangle_normals(XB, FB);

  Eigen::VectorXd distance(samples);
  Eigen::VectorXd degrees(samples);
  parallel_for(samples, [&](std::int64_t i) {
    const ClosestPoint::Hit hit = closest(spread.X.row(i));
    distance[i] = hit.distance;
    degrees[i] = degrees_between(normals_a.row(spread.triangle[static_cast<std::size_t>(i)]),
                                 normals_b.row(hit.triangle));
  });
  Eigen::VectorXd vertex_distance(vertices.rows());
  parallel_for(vertices.rows(),
               [&](std::int64_t v) { vertex_distance[v] = closest(vertices.row(v)).distance; });

  const Statistics over_area = summarise(distance);
  const Statistics over_vertices = summarise(vertex_distance);
  DirectedDistance result{over_area.mean, over_area.rms, over_area.max,
                          spread.X.row(over_area.where), summarise_angles(degrees)};
  if (over_vertices.max > result.max) {
    result.max = over_vertices.max;
    result.farthest = vertices.row(over_vertices.where);
  }
  return result;
}

}  // namespace ibmfair
