#include "ibmfair/fill/sharp_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/quantile.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr std::size_t most_edges = 7;  // of a line that is followed
constexpr double least_sharp_angle = radians(25.0);
constexpr double largest_sharp_angle = radians(90.0);
constexpr double sharp_in_quartiles = 12;       // of all edges' turns; about 4 standard deviations
constexpr double most_dead_ends = 0.1;          // of the vertices with sharp edges
constexpr double largest_bend = radians(45.0);  // of a line at a vertex; more is a corner

}  // namespace

Index SharpLines::beyond(Index t, Index v, Index w) const {
  Index found = -1;
  for (const Index u : topology_.stars[v]) {
    if (u != t && (topology_.F.row(u).array() == w).any()) {
      if (found >= 0) {
        return -1;
      }
      found = u;
    }
  }
  return found;
}

bool SharpLines::turns(Index t, Index u) const {
  return angle_between(double_area_vector(X_, topology_.F, t),
                       double_area_vector(X_, topology_.F, u)) > angle_;
}

std::vector<Index> SharpLines::sharp_neighbors(Index v) const {
  std::vector<Index> result;
  for (const Index t : topology_.stars[v]) {
    const Index w = other_corners(topology_.F, t, v)[0];
    const Index u = beyond(t, v, w);
    if (u >= 0 && turns(t, u)) {
      result.push_back(w);
    }
  }
  return result;
}

SharpLine SharpLines::follow(Index v, Index w) const {
  SharpLine line{{v, w}};
  while (line.vertices.size() <= most_edges) {
    const Index before = line.vertices.end()[-2], at = line.vertices.back();
    if (topology_.kind[at] != VertexKind::interior) {
      return line;
    }
    std::vector<Index> next = sharp_neighbors(at);
    std::erase(next, before);
    if (next.size() != 1) {
      line.ends_well = !next.empty();
      return line;
    }
    const Vec3 come = X_.row(at) - X_.row(before), go = X_.row(next.front()) - X_.row(at);
    if (angle_between(come, go) > largest_bend || next.front() == v) {
      return line;
    }
    line.vertices.push_back(next.front());
  }
  return line;
}

double sharp_angle_of(const Points& X, const Topology& topology) {
  const Eigen::VectorXd turns = std::numbers::pi - dihedral_angles(X, topology.H).array();
  if (turns.size() == 0) {
    return 0;
  }
  std::vector<double> sorted(turns.begin(), turns.end());
  const double angle = std::max(least_sharp_angle, sharp_in_quartiles * quantile(sorted, 0.25));
  std::vector<int> sharp(static_cast<std::size_t>(topology.vertex_count), 0);
  for (Eigen::Index h = 0; h < turns.size(); ++h) {
    if (turns[h] > angle) {
      ++sharp[topology.H(h, 0)];
      ++sharp[topology.H(h, 1)];
    }
  }
  int all = 0, dead_ends = 0;
  for (std::size_t v = 0; v < sharp.size(); ++v) {
    if (topology.kind[v] == VertexKind::interior) {
      all += sharp[v] > 0 ? 1 : 0;
      dead_ends += sharp[v] == 1 ? 1 : 0;
    }
  }
  return angle <= largest_sharp_angle && dead_ends <= most_dead_ends * all ? angle : 0;
}

}  // namespace ibmfair
