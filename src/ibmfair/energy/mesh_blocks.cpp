#include "ibmfair/energy/mesh_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/vertex_blocks.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

constexpr std::size_t lanes = lanes_per_group;

/// Where the groups list corner i of the triangle in a slot.
std::size_t place_of_corner(std::size_t slot, int i) {
  return 3 * lanes * (slot / lanes) + lanes * i + slot % lanes;
}

/// What all blocks are cut from.
struct WholeMesh {
  const Topology& topology;
  const std::vector<std::uint8_t>& kept;
  const BlockSurroundings& surroundings;
  const std::vector<std::uint8_t>& counted;
  const std::vector<Index>& owned;
  std::vector<Index> position;  // #V, in `owned`, or -1
};

/// Numbers for a few vertices or triangles among many: a hash table, which stays in the cache. A
/// list of all, one for each thread, would not.
class LocalNumbers {
 public:
  void clear() {
    ++stamp_;
    count_ = 0;
  }

  /// The number of `key`, -1 at first. The reference holds until the next call.
  Index& operator[](Index key) {
    if (2 * count_ >= entries_.size()) {
      grow();
    }
    Entry& entry = *find(key);
    if (entry.stamp != stamp_) {
      entry = {stamp_, key, -1};
      ++count_;
    }
    return entry.number;
  }

 private:
  struct Entry {
    Index stamp = -1;  // what stands there is of the block with this one
    Index key = 0, number = 0;
  };

  Entry* find(Index key) {
    constexpr std::uint32_t golden = 2654435769;  // 2^32 over the golden ratio
    std::size_t place = (static_cast<std::uint32_t>(key) * golden) >> shift_;
    while (entries_[place].stamp == stamp_ && entries_[place].key != key) {
      place = (place + 1) & (entries_.size() - 1);
    }
    return &entries_[place];
  }

  void grow() {
    const std::vector<Entry> before =
        std::exchange(entries_, std::vector<Entry>(2 * entries_.size()));
    --shift_;
    for (const Entry& entry : before) {
      if (entry.stamp == stamp_) {
        *find(entry.key) = entry;
      }
    }
  }

  static constexpr int first_bits = 13;
  std::vector<Entry> entries_ = std::vector<Entry>(std::size_t{1} << first_bits);
  int shift_ = 32 - first_bits;
  std::size_t count_ = 0;
  Index stamp_ = 0;
};

/// Makes one block after the other.
class Builder {
 public:
  explicit Builder(const WholeMesh& mesh) : mesh_(mesh) {}

  MeshBlock build(std::int64_t first_owned, std::int64_t last_owned) {
    vertex_.clear();
    triangle_.clear();
    block_ = {};
    block_.first_owned = first_owned;
    block_.owned = static_cast<Index>(last_owned - first_owned);
    find_triangles();
    if (mesh_.surroundings.whole_stars) {
      make_fans();
    } else {
      make_groups();
    }
    return std::move(block_);
  }

 private:
  bool is_own(Index v) const {
    const std::int64_t position = mesh_.position[v] - block_.first_owned;
    return position >= 0 && position < block_.owned;
  }

  void find_triangles() {
    own_.clear();
    shared_.clear();
    for (Index i = 0; i < block_.owned; ++i) {
      for (const Index t : mesh_.topology.stars[mesh_.owned[block_.first_owned + i]]) {
        if (mesh_.kept[t] && is_new(t)) {
          const bool counts = mesh_.counted.empty() || mesh_.counted[t] != 0;
          (counts && is_own(mesh_.topology.F(t, 0)) ? own_ : shared_).push_back(t);
        }
      }
    }
  }

  void make_groups() {
    const auto groups = [&] { return static_cast<std::int64_t>(slots_.size() / lanes); };
    slots_.clear();
    place(own_);
    block_.own_groups = groups();
    place(shared_);
    block_.groups = groups();
    write_corners(0);
    block_.rim = static_cast<Index>(block_.halo.size());
    const std::size_t count = slots_.size();
    if (!mesh_.surroundings.neighbours.empty()) {
      find_neighbours();
    }
    block_.outer_groups = groups();
    write_corners(count);
  }

  void make_fans() {
    append_fans({own_, shared_});
    block_.groups = static_cast<std::int64_t>(block_.fans.size());
    block_.rim = static_cast<Index>(block_.halo.size());
    find_stars();
    append_fans({shared_});
    block_.outer_groups = static_cast<std::int64_t>(block_.fans.size());
  }

  void append_fans(std::initializer_list<std::span<const Index>> lists) {
    triples_.clear();
    for (const std::span<const Index> triangles : lists) {
      for (const Index t : triangles) {
        const auto x = mesh_.topology.F.row(t);
        triples_.push_back({number_of(x[0]), number_of(x[1]), number_of(x[2])});
      }
    }
    const auto vertices = filler_vertices + block_.owned + static_cast<Index>(block_.halo.size());
    cover_.append(triples_, vertices, vertex_size, block_.corners, block_.fans);
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
      triangle_[triangles[i]] = static_cast<Index>(slot);
    }
  }

  void find_neighbours() {
    const std::size_t count = slots_.size();
    block_.neighbours.resize(3 * count);
    for (std::size_t slot = 0; slot < count; ++slot) {
      for (int i = 0; i < 3; ++i) {
        const Index t = slots_[slot];
        const Index other =
            t == no_triangle ? no_triangle : mesh_.surroundings.neighbours[3 * std::size_t(t) + i];
        block_.neighbours[place_of_corner(slot, i)] =
            row_size * (other == no_triangle ? static_cast<Index>(slot) : slot_of(other));
      }
    }
    slots_.resize((slots_.size() + lanes - 1) / lanes * lanes, no_triangle);
  }

  /// A neighbour that looks to the other side gets a slot of its own, turned over.
  Index slot_of(Index t) {
    const auto next = static_cast<Index>(slots_.size());
    if (t < 0) {
      slots_.push_back(t);
      return next;
    }
    Index& slot = triangle_[t];
    if (slot < 0) {
      slot = next;
      slots_.push_back(t);
    }
    return slot;
  }

  void find_stars() {
    shared_.clear();
    for (const Index position : block_.halo) {
      for (const Index t : mesh_.topology.stars[mesh_.owned[position]]) {
        if (mesh_.kept[t] && is_new(t)) {
          shared_.push_back(t);
        }
      }
    }
  }

  /// Whether the block has not had this triangle before.
  bool is_new(Index t) {
    Index& slot = triangle_[t];
    if (slot >= 0) {
      return false;
    }
    slot = 0;
    return true;
  }

  /// In the block.
  Index number_of(Index v) {
    const Index position = mesh_.position[v];
    if (is_own(v)) {
      return filler_vertices + static_cast<Index>(position - block_.first_owned);
    }
    Index& number = vertex_[v];
    if (number < 0) {
      number = filler_vertices + block_.owned + static_cast<Index>(block_.halo.size());
      block_.halo.push_back(position);
    }
    return number;
  }

  void write_corners(std::size_t first_slot) {
    block_.corners.resize(3 * slots_.size());
    for (std::size_t slot = first_slot; slot < slots_.size(); ++slot) {
      std::array<Index, 3> x{0, 1, 2};
      if (const Index t = slots_[slot]; t != no_triangle) {
        const auto corners = mesh_.topology.F.row(t >= 0 ? t : ~t);
        x = {number_of(corners[0]), number_of(corners[1]), number_of(corners[2])};
        if (t < 0) {
          std::swap(x[1], x[2]);
        }
      }
      for (int i = 0; i < 3; ++i) {
        block_.corners[place_of_corner(slot, i)] = vertex_size * x[i];
      }
    }
  }

  const WholeMesh& mesh_;
  LocalNumbers vertex_;    // those it does not own
  LocalNumbers triangle_;  // slots
  std::vector<Index> own_, shared_, slots_;
  CornerTriples triples_;
  FanCover cover_;
  MeshBlock block_;
};

}  // namespace

void MeshBlocks::load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const {
  const std::size_t count = static_cast<std::size_t>(filler_vertices + b.owned) + b.halo.size();
  if (vertices.size() < count) {
    vertices.resize(count);
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
  for (const Index position : b.halo) {
    load_one(owned[position]);
  }
}

void MeshBlocks::load(const MeshBlock& b, const std::vector<double>& w,
                      BlockVertices& vertices) const {
  BlockVertex* to = &vertices[filler_vertices];
  for (Index i = 0; i < b.owned; ++i) {
    (to++)->x.w = w[b.first_owned + i];
  }
  for (const Index position : b.halo) {
    (to++)->x.w = w[position];
  }
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
                       const BlockSurroundings& surroundings,
                       const std::vector<std::uint8_t>& counted) {
  MeshBlocks blocks;
  Rows vertices = vertex_blocks(topology, kept);
  blocks.owned = std::move(vertices.value);
  WholeMesh mesh{topology, kept, surroundings, counted, blocks.owned, {}};
  mesh.position.resize(static_cast<std::size_t>(topology.vertex_count), -1);
  parallel_for(static_cast<std::int64_t>(blocks.owned.size()),
               [&](std::int64_t i) { mesh.position[blocks.owned[i]] = static_cast<Index>(i); });
  blocks.untouched =
      indices_where(topology.vertex_count, [&](Index v) { return mesh.position[v] < 0; });
  const auto count = static_cast<std::int64_t>(vertices.size());
  blocks.block.resize(static_cast<std::size_t>(count));
  constexpr std::int64_t blocks_per_task = 4;
  const auto build_some = [&](std::int64_t task) {
    Builder builder(mesh);
    const std::int64_t first = task * blocks_per_task;
    for (std::int64_t b = first; b < std::min(count, first + blocks_per_task); ++b) {
      blocks.block[b] = builder.build(vertices.first[b], vertices.first[b + 1]);
    }
  };
  run_tasks((count + blocks_per_task - 1) / blocks_per_task, blocks.are_worth_sharing(),
            build_some);
  return blocks;
}

}  // namespace ibmfair
