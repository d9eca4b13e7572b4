#include "ibmfair/energy/vertex_blocks.h"

#include <algorithm>

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/select.h"

namespace ibmfair {
namespace {

/// Vertices in a block. The data kept for them takes about 350 kB, and data on its way from and to
/// memory another 100 kB; both fit into a second-level cache of 512 kB. With such a cache, a third
/// more vertices took the same time; a third fewer took one or two percent more, because more
/// triangles lie in two blocks.
constexpr std::size_t block_size = 1536;

/// A triangle is computed in each block that owns one of its corners. Runs of the input's order are
/// used if the average number of these blocks is at most this; for grown blocks it is about 1.1.
constexpr double acceptable_repetition = 1.2;

std::vector<Index> corners_of(const Topology& topology, const std::vector<std::uint8_t>& kept) {
  return indices_where(topology.vertex_count, [&](Index v) {
    const auto star = topology.stars[v];
    return std::any_of(star.begin(), star.end(), [&](Index t) { return kept[t] != 0; });
  });
}

/// Blocks of nearly equal length, without their vertices.
CompressedRows empty_blocks(std::size_t vertices) {
  CompressedRows blocks;
  const std::size_t count = (vertices + block_size - 1) / block_size;
  for (std::size_t b = 1; b <= count; ++b) {
    blocks.first.push_back(static_cast<std::int64_t>(vertices * b / count));
  }
  return blocks;
}

/// Cuts the list into runs.
CompressedRows runs(std::vector<Index> vertices) {
  CompressedRows blocks = empty_blocks(vertices.size());
  blocks.value = std::move(vertices);
  return blocks;
}

/// The average number of blocks that own a corner of a triangle.
double repetition(const Topology& topology, const std::vector<std::uint8_t>& kept,
                  const CompressedRows& blocks) {
  std::vector<Index> block_of(static_cast<std::size_t>(topology.vertex_count), -1);
  for (Index b = 0; b < blocks.size(); ++b) {
    for (const Index v : blocks[b]) {
      block_of[v] = b;
    }
  }
  const auto count = [&](std::int64_t t) -> Eigen::Array2d {
    if (!kept[t]) {
      return {0, 0};
    }
    const Index a = block_of[topology.F(t, 0)], b = block_of[topology.F(t, 1)],
                c = block_of[topology.F(t, 2)];
    return {1, 1 + (b != a) + (c != a && c != b)};
  };
  const Eigen::Array2d triangles_and_places =
      parallel_sum(topology.F.rows(), Eigen::Array2d(Eigen::Array2d::Zero()), count);
  return triangles_and_places[1] / std::max(triangles_and_places[0], 1.0);
}

/// Each block grows from a vertex where an earlier block stopped, so that no gaps are left between
/// blocks. Blocks list vertices in the order in which they grow: if a mesh is numbered in this
/// order, runs of it are the same blocks.
CompressedRows grown(const Topology& topology, const std::vector<std::uint8_t>& kept,
                     const std::vector<Index>& vertices) {
  enum State : std::uint8_t { free, waiting, taken };
  std::vector<std::uint8_t> state(static_cast<std::size_t>(topology.vertex_count), free);
  CompressedRows blocks = empty_blocks(vertices.size());
  blocks.value.reserve(vertices.size());
  std::vector<Index> seeds = vertices;  // last resort: the first free vertex in the input order
  std::size_t next_seed = 0;
  std::vector<Index> front;  // reached by earlier blocks, but not taken
  std::size_t next_front = 0;
  std::vector<Index> queue;
  for (Index b = 0; b < blocks.size(); ++b) {
    queue.clear();
    std::size_t next = 0;
    while (static_cast<std::int64_t>(blocks.value.size()) < blocks.first[b + 1]) {
      if (next == queue.size()) {
        while (next_front < front.size() && state[front[next_front]] == taken) {
          ++next_front;
        }
        while (next_seed < seeds.size() && state[seeds[next_seed]] == taken) {
          ++next_seed;
        }
        queue.push_back(next_front < front.size() ? front[next_front] : seeds[next_seed]);
      }
      const Index v = queue[next++];
      state[v] = taken;
      blocks.value.push_back(v);
      for (const Index t : topology.stars[v]) {
        for (int i = 0; i < 3 && kept[t]; ++i) {
          if (const Index w = topology.F(t, i); state[w] == free) {
            state[w] = waiting;
            queue.push_back(w);
          }
        }
      }
    }
    for (; next < queue.size(); ++next) {
      state[queue[next]] = free;
      front.push_back(queue[next]);
    }
  }
  return blocks;
}

}  // namespace

CompressedRows vertex_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept) {
  const std::vector<Index> vertices = corners_of(topology, kept);
  CompressedRows blocks = runs(vertices);
  return repetition(topology, kept, blocks) <= acceptable_repetition
             ? blocks
             : grown(topology, kept, vertices);
}

}  // namespace ibmfair
