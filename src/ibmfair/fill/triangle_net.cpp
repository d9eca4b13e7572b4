#include "ibmfair/fill/triangle_net.h"

#include <algorithm>
#include <utility>

namespace ibmfair {
namespace {

struct OpenSide {
  Index low, high, triangle, corner;
};

}  // namespace

void TriangleNet::append(const Triangles& F) {
  const Index first = size();
  std::vector<OpenSide> edges;
  edges.reserve(3 * static_cast<std::size_t>(F.rows()));
  for (Index t = 0; t < F.rows(); ++t) {
    corner_.push_back({F(t, 0), F(t, 1), F(t, 2)});
    across_.push_back({-1, -1, -1});
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
      across_[a.triangle][a.corner] = b.triangle;
      across_[b.triangle][b.corner] = a.triangle;
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

NetEdge TriangleNet::other_side(NetEdge e) const {
  const Index u = across_[e.triangle][e.corner];
  if (u < 0) {
    return {};
  }
  // The corner before the start of the edge in `u` is the one opposite: u runs end, start, apex.
  return {u, (place(u, start(e)) + 1) % 3};
}

bool TriangleNet::joined(Index t, Index v, Index w) const {
  // Once around v in each direction, until the rim or back at the start.
  for (const int turn : {1, 2}) {
    Index at = t;
    do {
      const auto& corners = corner_[at];
      if (corners[0] == w || corners[1] == w || corners[2] == w) {
        return true;
      }
      at = across_[at][(place(at, v) + turn) % 3];
    } while (at >= 0 && at != t);
    if (at == t) {
      return false;
    }
  }
  return false;
}

void TriangleNet::redirect(Index t, Index from, Index to) {
  if (t >= 0) {
    std::replace(across_[t].begin(), across_[t].end(), from, to);
  }
}

void TriangleNet::flip(NetEdge e) {
  const NetEdge o = other_side(e);
  const Index t = e.triangle, u = o.triangle;
  const Index a = start(e), b = end(e), p = opposite(e), q = opposite(o);
  const Index beyond_bp = across_[t][(e.corner + 1) % 3],
              beyond_pa = across_[t][(e.corner + 2) % 3];
  const Index beyond_aq = across_[u][(o.corner + 1) % 3],
              beyond_qb = across_[u][(o.corner + 2) % 3];
  corner_[t] = {p, a, q};
  across_[t] = {beyond_aq, u, beyond_pa};
  corner_[u] = {q, b, p};
  across_[u] = {beyond_bp, t, beyond_qb};
  redirect(beyond_aq, u, t);
  redirect(beyond_bp, t, u);
}

void TriangleNet::split(NetEdge e, Index v) {
  const NetEdge o = other_side(e);
  const Index t = e.triangle, u = o.triangle;
  const Index a = start(e), b = end(e), p = opposite(e), q = opposite(o);
  const Index beyond_bp = across_[t][(e.corner + 1) % 3],
              beyond_pa = across_[t][(e.corner + 2) % 3];
  const Index beyond_aq = across_[u][(o.corner + 1) % 3],
              beyond_qb = across_[u][(o.corner + 2) % 3];
  const Index t2 = size(), u2 = t2 + 1;
  corner_[t] = {p, a, v};
  across_[t] = {u, t2, beyond_pa};
  corner_[u] = {q, v, a};
  across_[u] = {t, beyond_aq, u2};
  corner_.push_back({p, v, b});
  across_.push_back({u2, beyond_bp, t});
  corner_.push_back({q, b, v});
  across_.push_back({t2, u, beyond_qb});
  redirect(beyond_bp, t, t2);
  redirect(beyond_qb, u, u2);
}

}  // namespace ibmfair
