#include "ibmfair/io/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

std::size_t hash_position(const Points& X, Eigen::Index v) {
  std::uint64_t hash = 0;
  for (int c = 0; c < 3; ++c) {
    // Adding zero turns -0 into +0. The multiplier is that of a 64-bit linear congruential
    // generator; the shift mixes the high bits into the low bits, which select the slot of the
    // table.
    hash = (hash ^ std::bit_cast<std::uint64_t>(X(v, c) + 0.0)) * 6364136223846793005U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

/// Vertices sorted into the cells of a grid. Usually the cells are so small that all vertices of
/// one cell are close to each other; but cells are never so small that rounding changes their
/// numbers by more than 1/256.
class CloseVertices {
 public:
  CloseVertices(const Points& X, double tolerance)
      : X_(X), tolerance_(tolerance), joined_(static_cast<Index>(X.rows())) {
    // Halves, because the difference of two coordinates may overflow.
    const Vec3 low = X.colwise().minCoeff() / 2, high = X.colwise().maxCoeff() / 2;
    const double wanted = 0.99 * tolerance / std::sqrt(3.0) / 2;
    const double size = std::max(
        {wanted, (high - low).maxCoeff() / most_cells, std::numeric_limits<double>::min()});
    small_cells_ = size == wanted;
    const auto count = static_cast<std::size_t>(X.rows());
    table_.assign(std::bit_ceil(2 * count + 1), -1);
    next_.assign(count, -1);
    cell_.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      for (int c = 0; c < 3; ++c)
        cell_[v][c] = static_cast<std::int64_t>((X(row, c) / 2 - low[c]) / size);
      Index& head = table_[slot_of(cell_[v])];
      if (head >= 0) next_[v] = head;
      head = static_cast<Index>(v);
    }
  }

  UnionFind join() {
    for (const Index head : table_) {
      if (head >= 0) join_cell(head);
    }
    for (const Index head : table_) {
      if (head >= 0) join_neighbours(head);
    }
    return std::move(joined_);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  /// The slot of the cell: the one that holds it, or the free one where it belongs.
  std::size_t slot_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t number : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(number)) * 6364136223846793005U;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (table_.size() - 1);
    while (table_[slot] >= 0 && cell_[table_[slot]] != cell)
      slot = (slot + 1) & (table_.size() - 1);
    return slot;
  }

  bool is_close(Index v, Index w) const {
    return (X_.row(v) - X_.row(w)).stableNorm() <= tolerance_;
  }

  void join_cell(Index head) {
    for (Index v = next_[head]; v >= 0; v = next_[v]) {
      if (small_cells_) {
        joined_.unite(head, v);
        continue;
      }
      for (Index w = head; w != v; w = next_[w]) {
        if (is_close(v, w)) joined_.unite(v, w);
      }
    }
  }

  void join_neighbours(Index head) {
    constexpr std::int64_t reach = 2;  // cells; the diagonal of a cell is 0.99 tolerances
    for (std::int64_t x = -reach; x <= reach; ++x) {
      for (std::int64_t y = -reach; y <= reach; ++y) {
        for (std::int64_t z = -reach; z <= reach; ++z) {
          const Cell& cell = cell_[head];
          const Cell near{cell[0] + x, cell[1] + y, cell[2] + z};
          if (const Index other = table_[slot_of(near)]; other > head) join_cells(head, other);
        }
      }
    }
  }

  void join_cells(Index head, Index other) {
    for (Index v = head; v >= 0; v = next_[v]) {
      for (Index w = other; w >= 0; w = next_[w]) {
        if (small_cells_ && joined_.find(head) == joined_.find(other)) return;
        if (is_close(v, w)) joined_.unite(v, w);
      }
    }
  }

  static constexpr double most_cells = 17592186044416.0;  // along an axis: 2^44

  const Points& X_;
  double tolerance_;
  bool small_cells_ = true;
  UnionFind joined_;
  std::vector<Cell> cell_;
  std::vector<Index> next_;   // #V, the next vertex of the same cell
  std::vector<Index> table_;  // a vertex of each cell, by the hash of the cell
};

}  // namespace

Weld find_coincident_vertices(const Points& X) {
  const auto count = static_cast<std::size_t>(X.rows());
  const std::size_t size = std::bit_ceil(2 * count + 1);
  std::vector<Index> table(size, -1);  // numbers of new vertices
  Weld weld;
  weld.vertex.resize(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    std::size_t slot = hash_position(X, row) & (size - 1);
    while (table[slot] >= 0 && X.row(weld.first[table[slot]]) != X.row(row)) {
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot] < 0) {
      table[slot] = static_cast<Index>(weld.first.size());
      weld.first.push_back(static_cast<Index>(v));
    }
    weld.vertex[v] = table[slot];
  }
  return weld;
}

Weld find_close_vertices(const Points& X, double tolerance) {
  UnionFind joined = CloseVertices(X, tolerance).join();
  const auto count = static_cast<Index>(X.rows());
  Weld weld;
  weld.vertex.resize(static_cast<std::size_t>(count));
  for (Index v = 0; v < count; ++v) {
    const Index first = joined.find(v);
    if (first == v) {
      weld.vertex[v] = static_cast<Index>(weld.first.size());
      weld.first.push_back(v);
    } else {
      weld.vertex[v] = weld.vertex[first];
    }
  }
  return weld;
}

Weld combined(const Weld& first, const Weld& then) {
  Weld both;
  for (const Index v : first.vertex)
    both.vertex.push_back(then.vertex[v]);
  for (const Index v : then.first)
    both.first.push_back(first.first[v]);
  return both;
}

void apply(const Weld& weld, Mesh& mesh) {
  mesh.X = mesh.X(weld.first, Eigen::all).eval();
  for (Index& v : mesh.faces.corner)
    v = weld.vertex[v];
}

KeptFaces remove_collapsed(Polygons& faces) {
  KeptFaces kept;
  Polygons rest;
  std::vector<Index> corners;
  for (Index f = 0; f < faces.size(); ++f) {
    const std::size_t before = kept.corner.size();
    corners.clear();
    Index previous = faces[f].back();
    for (std::int64_t i = faces.first[f]; i < faces.first[f + 1]; ++i) {
      const Index v = faces.corner[i];
      if (v != previous) {
        corners.push_back(v);
        kept.corner.push_back(i);
      }
      previous = v;
    }
    if (corners.size() < 3) {
      kept.corner.resize(before);
    } else {
      kept.face.push_back(f);
      rest.add(corners);
    }
  }
  faces = std::move(rest);
  return kept;
}

}  // namespace ibmfair
