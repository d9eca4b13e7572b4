#include "ibmfair/energy/mesh_blocks.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "ibmfair/base/parallel.h"
#include "ibmfair/energy/block_rows.h"
#include "ibmfair/energy/vertex_blocks.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// The mesh data from which all blocks are built.
struct WholeMesh {
  const Topology& topology;
  const std::vector<std::uint8_t>& kept;
  const BlockSurroundings& surroundings;
  const std::vector<std::uint8_t>& counted;
  const std::vector<Index>& owned;
  std::vector<Index> position;  // #V, in `owned`, or -1
};

/// Local numbers for a few of many vertices or triangles: a hash table, which stays in the cache.
/// An array over all vertices or triangles, one for each thread, would not.
class LocalNumbers {
 public:
  void clear() {
    ++stamp_;
    count_ = 0;
  }

  /// The number of `key`, initially -1. The reference is valid until the next call.
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

  /// Inserts the key if it is new, and returns whether it is.
  bool insert(Index key) {
    Index& number = (*this)[key];
    if (number >= 0) {
      return false;
    }
    number = 0;
    return true;
  }

 private:
  struct Entry {
    Index stamp = -1;  // the entry is valid if this equals stamp_, the current block's stamp
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

/// Builds one block after another.
class Builder {
 public:
  explicit Builder(const WholeMesh& mesh) : mesh_(mesh) {}

  MeshBlock build(std::int64_t first_owned, std::int64_t last_owned) {
    vertex_.clear();
    triangle_.clear();
    beside_.clear();
    listed_.clear();
    block_ = {};
    block_.first_owned = first_owned;
    block_.owned = static_cast<Index>(last_owned - first_owned);
    find_triangles();
    if (mesh_.surroundings.whole_stars) {
      take_whole_stars();
    } else {
      take_neighbours();
    }
    find_lines();
    return std::move(block_);
  }

 private:
  bool is_own(Index v) const {
    const std::int64_t position = mesh_.position[v] - block_.first_owned;
    return position >= 0 && position < block_.owned;
  }

  void find_triangles() {
    triangles_.clear();
    shared_.clear();
    for (Index i = 0; i < block_.owned; ++i) {
      for (const Index t : mesh_.topology.stars[mesh_.owned[block_.first_owned + i]]) {
        if (mesh_.kept[t] && triangle_.insert(t)) {
          const bool counts = mesh_.counted.empty() || mesh_.counted[t] != 0;
          (counts && is_own(mesh_.topology.F(t, 0)) ? triangles_ : shared_).push_back(t);
        }
      }
    }
    own_ = triangles_.size();
    triangles_.insert(triangles_.end(), shared_.begin(), shared_.end());
  }

  void take_whole_stars() {
    append_fans(0);
    block_.groups = group_count();
    block_.rim = static_cast<Index>(block_.halo.size());
    const std::size_t count = triangles_.size();
    find_stars();
    append_fans(count);
    block_.outer_groups = group_count();
  }

  void take_neighbours() {
    const std::size_t count = triangles_.size();
    find_neighbours();
    append_fans(0, own_);
    block_.own_groups = group_count();
    append_fans(own_, count);
    block_.groups = group_count();
    block_.rim = static_cast<Index>(block_.halo.size());
    if (!beside_.empty()) {
      block_.neighbours.resize(block_.corners.size());
    }
    append_fans(count);
    block_.outer_groups = group_count();
    write_neighbours();
  }

  std::int64_t group_count() const { return static_cast<std::int64_t>(block_.fans.size()); }

  /// Appends fans of the triangles from number `first` on.
  void append_fans(std::size_t first) { append_fans(first, triangles_.size()); }

  /// Appends fans of the triangles first .. last - 1.
  void append_fans(std::size_t first, std::size_t last) {
    triples_.clear();
    joined_.clear();
    const auto offset = static_cast<Index>(first);
    for (std::size_t number = first; number < last; ++number) {
      const Index t = triangles_[number];
      const auto x = mesh_.topology.F.row(t >= 0 ? t : ~t);
      triples_.push_back({number_of(x[0]), number_of(x[1]), number_of(x[2])});
      if (t < 0) {
        std::swap(triples_.back()[1], triples_.back()[2]);
      }
      if (number < beside_.size()) {
        const auto& [a, b, c] = beside_[number];
        joined_.push_back({a - offset, b - offset, c - offset});
      }
    }
    const auto vertices = filler_vertices + block_.owned + static_cast<Index>(block_.halo.size());
    cover_.append(triples_, joined_, vertices, vertex_size, block_.corners, block_.fans);
    if (!beside_.empty()) {
      for (const Index place : cover_.listed()) {
        listed_.push_back(place < 0 ? -1 : place + 3 * offset);
      }
    }
  }

  /// Appends the neighbours that the block does not have yet to its triangles.
  void find_neighbours() {
    if (mesh_.surroundings.neighbours.empty()) {
      return;
    }
    const std::size_t count = triangles_.size();
    for (std::size_t number = 0; number < count; ++number) {
      triangle_[triangles_[number]] = static_cast<Index>(number);
    }
    for (std::size_t number = 0; number < count; ++number) {
      const Index* behind = &mesh_.surroundings.neighbours[3 * std::size_t(triangles_[number])];
      beside_.push_back({number_of_triangle(behind[0]), number_of_triangle(behind[1]),
                         number_of_triangle(behind[2])});
    }
  }

  /// The number of a triangle in the block; -1 for no triangle. A triangle of opposite orientation
  /// (~t) gets a new number of its own and is reversed.
  Index number_of_triangle(Index t) {
    if (t == no_triangle) {
      return -1;
    }
    const auto next = static_cast<Index>(triangles_.size());
    if (t < 0) {
      triangles_.push_back(t);
      return next;
    }
    Index& number = triangle_[t];
    if (number < 0) {
      number = next;
      triangles_.push_back(t);
    }
    return number;
  }

  /// A triangle, or filler, in a group.
  struct Listed {
    const FanGroup& group;
    std::int64_t i;     // index in the fan
    Index lane, place;  // `place` as in FanCover::listed()

    Index row() const { return static_cast<Index>(fans_per_group * (group.first_row + i) + lane); }
  };

  /// Calls act(listed) for all triangles in the first `groups` groups.
  template <class Act>
  void for_each_listed(std::int64_t groups, const Act& act) {
    const Index* place = listed_.data();
    for (std::int64_t g = 0; g < groups; ++g) {
      const FanGroup& group = block_.fans[g];
      for (std::int64_t i = 0; i < group.triangles; ++i) {
        for (Index lane = 0; lane < fans_per_group; ++lane) {
          act(Listed{group, i, lane, *place++});
        }
      }
    }
  }

  /// Writes the rows of the neighbours, once all triangles are in groups.
  void write_neighbours() {
    if (beside_.empty()) {
      return;
    }
    row_.resize(triangles_.size());
    for_each_listed(block_.outer_groups, [&](const Listed& one) {
      if (one.place >= 0) {
        row_[one.place / 3] = one.row();
      }
    });
    for_each_listed(block_.groups, [&](const Listed& one) {
      const auto row_behind = [&](Index corner) {
        const Index other = one.place < 0 ? -1 : beside_[one.place / 3][(one.place + corner) % 3];
        return row_size * (other < 0 ? one.row() : row_[other]);
      };
      Index* place = &block_.neighbours[one.group.first_place + one.lane];
      if (one.i == 0) {
        *place = row_behind(2);
      }
      place[fans_per_group * (one.i + 1)] = row_behind(0);
      if (one.i + 1 == one.group.triangles) {
        place[fans_per_group * (one.i + 2)] = row_behind(1);
      }
    });
  }

  void find_stars() {
    for (const Index v : block_.halo) {
      for (const Index t : mesh_.topology.stars[v]) {
        if (mesh_.kept[t] && triangle_.insert(t)) {
          triangles_.push_back(t);
        }
      }
    }
  }

  void find_lines() {
    line_.clear();
    for (Index i = 0; i < block_.owned; ++i) {
      add_lines_of(mesh_.owned[block_.first_owned + i]);
    }
    block_.own_line_count = block_.lines.size();
    for (const Index v : block_.halo) {
      add_lines_of(v);
    }
  }

  void add_lines_of(Index v) {
    for (const std::int64_t number : {3 * std::int64_t{v}, 3 * std::int64_t{v} + 2}) {
      const auto line = static_cast<Index>(number / numbers_per_line);
      if (line_.insert(line)) {
        block_.lines.push_back(line);
      }
    }
  }

  /// The number of a vertex in the block.
  Index number_of(Index v) {
    if (is_own(v)) {
      return filler_vertices + static_cast<Index>(mesh_.position[v] - block_.first_owned);
    }
    Index& number = vertex_[v];
    if (number < 0) {
      number = filler_vertices + block_.owned + static_cast<Index>(block_.halo.size());
      block_.halo.push_back(v);
    }
    return number;
  }

  const WholeMesh& mesh_;
  LocalNumbers vertex_;  // vertices that the block does not own
  LocalNumbers triangle_, line_;
  std::vector<Index> triangles_;  // the block's triangles; first those that only this block counts
  std::size_t own_ = 0;           // the number of these
  std::vector<Index> shared_;
  CornerTriples beside_;  // the triangles across the edges of triangles_, or -1
  CornerTriples triples_, joined_;
  FanCover cover_;
  std::vector<Index> listed_;  // for each place in the groups, as in FanCover::listed()
  std::vector<Index> row_;     // the row of each triangle
  MeshBlock block_;
};

}  // namespace

void MeshBlocks::load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const {
  const std::size_t count = static_cast<std::size_t>(filler_vertices + b.owned) + b.halo.size();
  if (vertices.size() < count + fans_per_group) {
    vertices.resize(count + fans_per_group);
  }
  vertices[0].x = {};
  for (Index i = 1; i < filler_vertices; ++i) {
    vertices[i].x = {1, static_cast<double>(i), 0, 0};
  }
  BlockVertex* own = &vertices[filler_vertices];
  load_rows(owned_of(b), X, own);
  load_rows(b.halo, X, own + b.owned);
}

void MeshBlocks::load(const MeshBlock& b, const PerVertex& w, BlockVertices& vertices) const {
  BlockVertex* to = &vertices[filler_vertices];
  for (const Index v : owned_of(b)) {
    (to++)->x.w = w[v];
  }
  for (const Index v : b.halo) {
    (to++)->x.w = w[v];
  }
}

void MeshBlocks::store(const MeshBlock& b, const BlockVertices& vertices, Points& G) const {
  store_sums(owned_of(b), &vertices[filler_vertices], G);
}

BlockPass MeshBlocks::fetching_sums(const MeshBlock& b, std::int64_t groups,
                                    const Points& G) const {
  return {b, groups, {G, b.own_lines(), groups}};
}

BlockPass MeshBlocks::fetching_next(const MeshBlock& b, std::int64_t groups,
                                    const Points& X) const {
  if (&b == &block.back()) {
    return {b, groups};
  }
  return {b, groups, {X, (&b + 1)->lines, groups}};
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
  CompressedRows vertices = vertex_blocks(topology, kept);
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
