#include "ibmfair/fill/slits.h"

#include <algorithm>
#include <limits>

#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

constexpr double most_width = 0.1;  // in mean edge lengths of the loop
// Of the angle between the direction across a slit and the direction into the mesh. Where a curved
// surface has edges of two lengths, the directions are at right angles.
constexpr double most_cosine = 0.5;
constexpr double endless = std::numeric_limits<double>::infinity();

std::vector<std::pair<Index, Index>> edges_of(const std::vector<Hole>& holes) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Hole& hole : holes) {
    for (Index i = 0; i < hole.edges(); ++i) {
      edges.emplace_back(hole.loop[i], hole.loop[(i + 1) % std::ssize(hole.loop)]);
    }
  }
  return edges;
}

std::vector<BoxGrid::Box> boxes_of(const Points& X,
                                   const std::vector<std::pair<Index, Index>>& edges) {
  std::vector<BoxGrid::Box> boxes;
  boxes.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    boxes.emplace_back(Vec3(X.row(a)));
    boxes.back().extend(Vec3(X.row(b)));
  }
  return boxes;
}

/// The vector from x to the nearest point of the edge ab.
Vec3 towards_edge(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double along = std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return a + along * edge - x;
}

}  // namespace

SlitSearch::SlitSearch(const Points& X, const Topology& topology, const std::vector<Hole>& holes)
    : X_(X), topology_(topology), edges_(edges_of(holes)), grid_(boxes_of(X, edges_)) {}

std::optional<double> SlitSearch::width_at(const Hole& hole) const {
  if (!hole.closed || !(hole.perimeter > 0)) {
    return {};
  }
  const auto n = static_cast<Index>(hole.loop.size());
  const double most = most_width * hole.perimeter / n;
  double width = 0;
  for (Index i = 0; i < n; ++i) {
    const Index last = hole.loop[(i + n - 1) % n], v = hole.loop[i], next = hole.loop[(i + 1) % n];
    double nearest = distance_at_end(last, v, next);
    if (!(nearest <= most)) {
      nearest = distance_across({X_.row(v), {{{last, v}, {v, next}}}}, most);
    }
    if (nearest <= most) {
      const Vec3 middle = (X_.row(v) + X_.row(next)).transpose() / 2;
      nearest = std::max(nearest, distance_across({middle, {{{v, next}, {v, next}}}}, most));
    }
    if (!(nearest <= most)) {
      return {};
    }
    width = std::max(width, nearest);
  }
  return width;
}

/// The distance from a point of the loop to the nearest edge, besides its own, that does not lie on
/// the side of the mesh; infinite if there is none within `most`.
double SlitSearch::distance_across(const RimPoint& point, double most) const {
  const Vec3 margin = Vec3::Constant(most);
  std::vector<Index> near;
  grid_.find({point.x - margin, point.x + margin}, near);
  double nearest = endless;
  for (const Index e : near) {
    if (edges_[e] == point.edges[0] || edges_[e] == point.edges[1]) {
      continue;
    }
    const Vec3 d = towards_edge(point.x, X_.row(edges_[e].first), X_.row(edges_[e].second));
    const double distance = d.norm();
    if (distance <= most && distance < nearest) {
      const Vec3 inward = inward_at(point.edges[0]) + inward_at(point.edges[1]);
      nearest = d.dot(inward.normalized()) > most_cosine * distance ? nearest : distance;
    }
  }
  return nearest;
}

/// How far apart the two edges are that meet in v, if they run along each other and the mesh is not
/// between them; else infinite.
double SlitSearch::distance_at_end(Index last, Index v, Index next) const {
  const Vec3 x = X_.row(v), y = X_.row(last), z = X_.row(next);
  if (!((y - x).dot(z - x) > 0) || inward_at({v, next}).dot(y - x) > 0) {
    return endless;
  }
  return (y - x).squaredNorm() < (z - x).squaredNorm() ? towards_edge(y, x, z).norm()
                                                       : towards_edge(z, x, y).norm();
}

/// The direction from an edge of a loop into the mesh, at a right angle to the edge; a unit vector.
Vec3 SlitSearch::inward_at(const LoopEdge& edge) const {
  const auto [a, b] = edge;
  const auto star = topology_.stars[a];
  const auto behind =
      std::ranges::find_if(star, [&](Index t) { return (topology_.F.row(t).array() == b).any(); });
  if (behind == star.end()) {
    return Vec3::Zero();
  }
  const Vec3 along = (X_.row(b) - X_.row(a)).normalized();
  const Vec3 to_apex = X_.row(opposite_vertex(topology_.F, *behind, a, b)) - X_.row(a);
  return (to_apex - along * along.dot(to_apex)).normalized();
}

}  // namespace ibmfair
