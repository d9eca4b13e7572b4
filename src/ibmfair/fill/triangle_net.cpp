#include "ibmfair/fill/triangle_net.h"

#include <algorithm>
#include <utility>

namespace ibmfair {
namespace {

struct OpenSide {
  Index low, high, triangle;
  int corner;
};

}  // namespace

void TriangleNet::append(const Triangles& F) {
  const Index first = size();
  std::vector<OpenSide> edges;
  edges.reserve(3 * static_cast<std::size_t>(F.rows()));
  for (Index t = 0; t < F.rows(); ++t) {
    corner_.push_back({F(t, 0), F(t, 1), F(t, 2)});
    across_.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(F(t, (i + 1) % 3), F(t, (i + 2) % 3));
      edges.push_back({low, high, first + t, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const OpenSide& a, const OpenSide& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  });
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const OpenSide &a = edges[i - 1], &b = edges[i];
    if (a.low == b.low && a.high == b.high) {
      join({a.triangle, a.corner}, {b.triangle, b.corner});
    }
  }
}

Triangles TriangleNet::triangles() const {
  Triangles F(size(), 3);
  for (Index t = 0; t < size(); ++t) {
    F.row(t) << corner_[t][0], corner_[t][1], corner_[t][2];
  }
  return F;
}

int TriangleNet::place(Index t, Index v) const {
  return corner_[t][0] == v ? 0 : corner_[t][1] == v ? 1 : 2;
}

bool TriangleNet::joined(Index t, Index v, Index w) const {
  // Visits the triangles around v in each direction, until the rim or the first triangle is
  // reached.
  for (const int turn : {1, 2}) {
    NetEdge at{t, (place(t, v) + 3 - turn) % 3};  // v is `turn` corners on from the edge entered by
    do {
      const auto& corners = corner_[at.triangle];
      if (corners[0] == w || corners[1] == w || corners[2] == w) {
        return true;
      }
      at = across_[at.triangle][(at.corner + 2 * turn) % 3];
    } while (at.triangle >= 0 && at.triangle != t);
    if (at.triangle == t) {
      return false;
    }
  }
  return false;
}

void TriangleNet::join(NetEdge e, NetEdge o) {
  for (const auto& [near, far] : {std::pair(e, o), std::pair(o, e)}) {
    if (near.triangle >= 0) {
      across_[near.triangle][near.corner] = far;
    }
  }
}

/// Makes `t` the triangle with these corners and these edges `across` its own.
void TriangleNet::put(Index t, const std::array<Index, 3>& corners,
                      const std::array<NetEdge, 3>& across) {
  corner_[t] = corners;
  for (int i = 0; i < 3; ++i) {
    join({t, i}, across[i]);
  }
}

void TriangleNet::flip(NetEdge e) {
  const NetEdge o = other_side(e);
  const Index t = e.triangle, u = o.triangle;
  const Index a = start(e), b = end(e), p = opposite(e), q = opposite(o);
  const NetEdge beyond_bp = across_[t][(e.corner + 1) % 3],
                beyond_pa = across_[t][(e.corner + 2) % 3];
  const NetEdge beyond_aq = across_[u][(o.corner + 1) % 3],
                beyond_qb = across_[u][(o.corner + 2) % 3];
  put(t, {p, a, q}, {beyond_aq, {u, 1}, beyond_pa});
  put(u, {q, b, p}, {beyond_bp, {t, 1}, beyond_qb});
}

void TriangleNet::split(NetEdge e, Index v) {
  const NetEdge o = other_side(e);
  const Index t = e.triangle, u = o.triangle;
  const Index a = start(e), b = end(e), p = opposite(e), q = opposite(o);
  const NetEdge beyond_bp = across_[t][(e.corner + 1) % 3],
                beyond_pa = across_[t][(e.corner + 2) % 3];
  const NetEdge beyond_aq = across_[u][(o.corner + 1) % 3],
                beyond_qb = across_[u][(o.corner + 2) % 3];
  const Index t2 = size(), u2 = t2 + 1;
  corner_.resize(corner_.size() + 2);
  across_.resize(across_.size() + 2);
  put(t, {p, a, v}, {NetEdge{u, 0}, {t2, 2}, beyond_pa});
  put(u, {q, v, a}, {NetEdge{t, 0}, beyond_aq, {u2, 1}});
  put(t2, {p, v, b}, {NetEdge{u2, 0}, beyond_bp, {t, 1}});
  put(u2, {q, b, v}, {NetEdge{t2, 0}, {u, 2}, beyond_qb});
}

}  // namespace ibmfair
