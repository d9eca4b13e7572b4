#include "ibmfair/energy/mesh_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_blocks.h"

namespace ibmfair {
namespace {

constexpr std::size_t lanes = lanes_per_group;

/// Where the groups list corner i of the triangle in a slot.
std::size_t place_of_corner(std::size_t slot, int i) {
  return 3 * lanes * (slot / lanes) + lanes * i + slot % lanes;
}

/// Numbers vertices and triangles within one block after the other. Each number bears the stamp of
/// its block, so that a new block clears nothing.
class Builder {
 public:
  Builder(const Topology& topology, const std::vector<std::uint8_t>& kept,
          const Neighbours& neighbours, const std::vector<std::uint8_t>& counted,
          MeshBlocks& blocks)
      : topology_(topology),
        kept_(kept),
        neighbours_(neighbours),
        counted_(counted),
        out_(blocks),
        position_(static_cast<std::size_t>(topology.vertex_count), -1),
        number_(position_.size()),
        triangle_(static_cast<std::size_t>(topology.F.rows())) {
    for (std::size_t i = 0; i < out_.owned.size(); ++i) {
      position_[out_.owned[i]] = static_cast<Index>(i);
    }
    for (Index v = 0; v < topology.vertex_count; ++v) {
      if (position_[v] < 0) {
        out_.untouched.push_back(v);
      }
    }
  }

  void add(std::int64_t first_owned, std::int64_t last_owned) {
    ++stamp_;
    block_ = {};
    block_.first_owned = first_owned;
    block_.owned = static_cast<Index>(last_owned - first_owned);
    block_.vertices = filler_vertices;
    block_.first_halo = static_cast<std::int64_t>(out_.halo.size());
    block_.first_corner = static_cast<std::int64_t>(out_.corners.size());
    block_.first_neighbour = static_cast<std::int64_t>(out_.neighbours.size());
    const std::span<const Index> owned(&out_.owned[first_owned], block_.owned);
    for (const Index v : owned) {
      number_[v] = {stamp_, block_.vertices++};
    }
    slots_.clear();
    find_triangles(owned);
    place(own_);
    block_.own_groups = groups();
    place(shared_);
    block_.groups = groups();
    if (!neighbours_.empty()) {
      find_neighbours();
    }
    block_.framed_groups = groups();
    write_corners();
    out_.block.push_back(block_);
  }

 private:
  struct Number {
    Index stamp = -1, value = 0;
  };

  std::int64_t groups() const { return static_cast<std::int64_t>(slots_.size() / lanes); }

  void find_triangles(std::span<const Index> owned) {
    own_.clear();
    shared_.clear();
    for (const Index v : owned) {
      for (const Index t : topology_.stars[v]) {
        if (kept_[t] && triangle_[t].stamp != stamp_) {
          triangle_[t].stamp = stamp_;
          const bool own =
              number_[topology_.F(t, 0)].stamp == stamp_ && (counted_.empty() || counted_[t] != 0);
          (own ? own_ : shared_).push_back(t);
        }
      }
    }
  }

  /// Spreads neighbours, which follow each other in the list, over different groups: what is added
  /// to a vertex in one group can then be in memory before the next one adds to it.
  void place(const std::vector<Index>& triangles) {
    const std::size_t count = (triangles.size() + lanes - 1) / lanes;
    const std::size_t first = slots_.size();
    slots_.resize(first + lanes * count, no_triangle);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const std::size_t slot = first + lanes * (i % count) + i / count;
      slots_[slot] = triangles[i];
      triangle_[triangles[i]].value = static_cast<Index>(slot);
    }
  }

  void find_neighbours() {
    const std::size_t count = slots_.size();
    out_.neighbours.resize(out_.neighbours.size() + 3 * count);
    Index* neighbour = &out_.neighbours[block_.first_neighbour];
    for (std::size_t slot = 0; slot < count; ++slot) {
      for (int i = 0; i < 3; ++i) {
        const Index t = slots_[slot];
        const Index other = t == no_triangle ? no_triangle : neighbours_[3 * std::size_t(t) + i];
        neighbour[place_of_corner(slot, i)] =
            row_size * (other == no_triangle ? static_cast<Index>(slot) : slot_of(other));
      }
    }
    slots_.resize((slots_.size() + lanes - 1) / lanes * lanes, no_triangle);
  }

  /// A neighbour that looks to the other side gets a slot of its own, turned over.
  Index slot_of(Index t) {
    const auto next = static_cast<Index>(slots_.size());
    if (t >= 0 && triangle_[t].stamp == stamp_) {
      return triangle_[t].value;
    }
    slots_.push_back(t);
    if (t >= 0) {
      triangle_[t] = {stamp_, next};
    }
    return next;
  }

  Index place_of_vertex(Index v) {
    if (number_[v].stamp != stamp_) {
      number_[v] = {stamp_, block_.vertices++};
      out_.halo.push_back(position_[v]);
    }
    return vertex_size * number_[v].value;
  }

  void write_corners() {
    out_.corners.resize(out_.corners.size() + 3 * slots_.size());
    Index* corner = &out_.corners[block_.first_corner];
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      std::array<Index, 3> x{0, vertex_size, 2 * vertex_size};
      if (const Index t = slots_[slot]; t != no_triangle) {
        const auto corners = topology_.F.row(t >= 0 ? t : ~t);
        x = {place_of_vertex(corners[0]), place_of_vertex(corners[1]), place_of_vertex(corners[2])};
        if (t < 0) {
          std::swap(x[1], x[2]);
        }
      }
      for (int i = 0; i < 3; ++i) {
        corner[place_of_corner(slot, i)] = x[i];
      }
    }
  }

  const Topology& topology_;
  const std::vector<std::uint8_t>& kept_;
  const Neighbours& neighbours_;
  const std::vector<std::uint8_t>& counted_;
  MeshBlocks& out_;
  std::vector<Index> position_;   // #V, in owned
  std::vector<Number> number_;    // #V
  std::vector<Number> triangle_;  // #F: slots
  std::vector<Index> own_, shared_, slots_;
  MeshBlock block_;
  Index stamp_ = -1;
};

/// Calls take(vertex of the block, its position in `owned`) for all of a block's vertices.
template <class Take>
void for_vertices_of(const MeshBlocks& blocks, const MeshBlock& b, BlockVertices& vertices,
                     const Take& take) {
  BlockVertex* to = &vertices[filler_vertices];
  for (Index i = 0; i < b.owned; ++i) {
    take(*to++, b.first_owned + i);
  }
  for (const Index position : blocks.halo_of(b)) {
    take(*to++, position);
  }
}

}  // namespace

void MeshBlocks::load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const {
  if (vertices.size() < static_cast<std::size_t>(b.vertices)) {
    vertices.resize(static_cast<std::size_t>(b.vertices));
  }
  vertices[0].x = {0, 0, 0, 0};
  vertices[1].x = {1, 0, 0, 0};
  vertices[2].x = {0, 1, 0, 0};
  BlockVertex* to = &vertices[filler_vertices];
  const auto load_one = [&](Index v) {
    std::memcpy(&to->x.x, X.data() + 3 * std::ptrdiff_t{v}, 3 * sizeof(double));
    to->sum = {};
    ++to;
  };
  for (const Index v : owned_of(b)) {
    load_one(v);
  }
  for (const Index position : halo_of(b)) {
    load_one(owned[position]);
  }
}

void MeshBlocks::load(const MeshBlock& b, const std::vector<BlockRow>& y,
                      BlockVertices& vertices) const {
  for_vertices_of(*this, b, vertices,
                  [&](BlockVertex& vertex, std::int64_t at) { vertex.y = y[at]; });
}

void MeshBlocks::load(const MeshBlock& b, const std::vector<double>& w,
                      BlockVertices& vertices) const {
  for_vertices_of(*this, b, vertices,
                  [&](BlockVertex& vertex, std::int64_t at) { vertex.x.w = w[at]; });
}

void MeshBlocks::store(const MeshBlock& b, const BlockVertices& vertices, Points& G) const {
  const BlockVertex* from = &vertices[filler_vertices];
  for (const Index v : owned_of(b)) {
    std::memcpy(G.data() + 3 * std::ptrdiff_t{v}, &from->sum.x, 3 * sizeof(double));
    ++from;
  }
}

void MeshBlocks::prepare(Points& G) const {
  G.resize(static_cast<Eigen::Index>(owned.size() + untouched.size()), 3);
  parallel_for(static_cast<std::int64_t>(untouched.size()),
               [&](std::int64_t i) { G.row(untouched[i]).setZero(); });
}

MeshBlocks mesh_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept,
                       const Neighbours& neighbours, const std::vector<std::uint8_t>& counted) {
  MeshBlocks blocks;
  Rows vertices = vertex_blocks(topology, kept);
  blocks.owned = std::move(vertices.value);
  Builder builder(topology, kept, neighbours, counted, blocks);
  const auto triangles = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 1));
  blocks.corners.reserve(3 * triangles + triangles / 2);
  blocks.neighbours.reserve(neighbours.empty() ? 0 : blocks.corners.capacity());
  for (std::size_t b = 0; b + 1 < vertices.first.size(); ++b) {
    builder.add(vertices.first[b], vertices.first[b + 1]);
  }
  blocks.corners.shrink_to_fit();
  blocks.neighbours.shrink_to_fit();
  return blocks;
}

}  // namespace ibmfair
