// The triangles of a mesh as the kernels of the energies process them: block by block, in groups of
// four fans. Each vertex is owned by one block, which computes all triangles at the vertex, even if
// another block computes the same triangle for another vertex. The block therefore forms the whole
// sum over the triangles around the vertex: no two threads write to the same place, the order of
// every sum is fixed, and no data per triangle is kept from one pass to the next.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/row4.h"
#include "ibmfair/base/types.h"
#include "ibmfair/energy/block_prefetch.h"
#include "ibmfair/energy/triangle_fans.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The data of a vertex in a block: `x` is read (at first the position), `sum` is added to. Both
/// share a cache line, and a block has few enough of these lines to keep them in the cache. In two
/// separate arrays, the addresses of x and sum of a vertex would agree in their last 12 bits; the
/// processor then would delay a load from one for a store to the other (4K aliasing).
struct alignas(64) BlockVertex {
  Row4 x, sum;
};
using BlockVertices = std::vector<BlockVertex>;

/// For each corner of each triangle (3 #F), the triangle across the opposite edge: t, or ~t if the
/// orientations of the two triangles disagree, or `no_triangle`.
using Neighbours = std::vector<Index>;
inline constexpr Index no_triangle = std::numeric_limits<Index>::max();

/// The first vertices of every block are those of a flat dummy fan, which fills incomplete groups.
inline constexpr Index filler_vertices = longest_fan + 2;

/// One block. Its vertices are the filler's, then the vertices that it owns, then the other corners
/// of its triangles.
struct MeshBlock {
  std::int64_t first_owned = 0;  ///< index into MeshBlocks::owned
  Index owned = 0;               ///< number of owned vertices
  std::vector<Index> halo;       ///< the vertices that it does not own, as numbered in the mesh
  Index rim = 0;                 ///< the first `rim` of `halo` are corners of the first `groups`
  std::vector<FanGroup> fans;    ///< the groups of fans
  std::vector<Index> corners;    ///< places of the fans' vertices: `vertex_size` times the vertex
  /// Laid out as `corners`, for the first `groups`: the triangle before the first triangle of a
  /// fan, the triangles across its rim, and the triangle after the last, each as `row_size` times
  /// its row. Triangle i of a fan has row 4 (FanGroup::first_row + i) + the fan's place in the
  /// group. A triangle without a neighbour is listed as its own neighbour.
  std::vector<Index> neighbours;
  std::int64_t own_groups = 0;  ///< the first groups: triangles that count, each in only one block
  std::int64_t groups = 0;  ///< these, and the groups of all other triangles at its own vertices
  std::int64_t outer_groups = 0;  ///< these, and the groups of the surroundings (BlockSurroundings)
  std::vector<Index> lines;  ///< the cache lines of Points that hold the vertices' rows, counted
                             ///< from the first row; the lines of its own vertices come first
  std::size_t own_line_count = 0;  ///< number of lines of its own vertices

  std::span<const Index> own_lines() const { return {lines.data(), own_line_count}; }
};

/// A loop over the first `groups` groups of a block, with one step of `fetch` after each group.
struct BlockPass {
  const MeshBlock& block;
  std::int64_t groups = 0;
  BlockPrefetch fetch = {};
};

/// Number of doubles in a BlockVertex.
inline constexpr Index vertex_size = sizeof(BlockVertex) / sizeof(double);

struct MeshBlocks {
  std::vector<MeshBlock> block;
  std::vector<Index> owned;      ///< the vertices of all blocks in turn, as numbered in the mesh
  std::vector<Index> untouched;  ///< the vertices that belong to no triangle of a block

  /// A block's own vertices, as numbered in the mesh.
  std::span<const Index> owned_of(const MeshBlock& b) const {
    return {owned.data() + b.first_owned, static_cast<std::size_t>(b.owned)};
  }

  /// Whether it pays to run a loop over the blocks on all threads. There are about twice as many
  /// triangles as vertices.
  bool are_worth_sharing() const {
    return 2 * static_cast<std::int64_t>(owned.size()) >= worth_sharing;
  }

  /// Loads the positions of a block's vertices from X (#V x 3) into x and sets the sums to zero.
  /// `vertices` grows if necessary but never shrinks, and has room for fans_per_group more
  /// vertices.
  void load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const;
  /// Loads the fourth number of x from w (#V).
  void load(const MeshBlock& b, const PerVertex& w, BlockVertices& vertices) const;
  /// Stores the sums of a block's own vertices in G (#V x 3).
  void store(const MeshBlock& b, const BlockVertices& vertices, Points& G) const;
  /// A loop that prefetches the rows of G that the block will store.
  BlockPass fetching_sums(const MeshBlock& b, std::int64_t groups, const Points& G) const;
  /// A loop that prefetches the rows of X of the next block, which is most likely also the next
  /// block of this thread.
  BlockPass fetching_next(const MeshBlock& b, std::int64_t groups, const Points& X) const;
  /// Makes G #V x 3, zero where no block stores anything.
  void prepare(Points& G) const;
};

/// The triangles of a block besides those at its own vertices.
struct BlockSurroundings {
  /// If given, the triangles adjacent to those at the block's own vertices; all of them must be
  /// `kept`. A fan continues from a triangle only to its neighbour in this table.
  Neighbours neighbours = {};
  /// All `kept` triangles around the corners of the triangles at the block's own vertices.
  bool whole_stars = false;
};

/// Blocks of the triangles that are `kept` (#F). Triangles that are not `counted` (#F, or empty for
/// all) are in no block's `own_groups`; with whole stars, no triangle is.
MeshBlocks mesh_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept,
                       const BlockSurroundings& surroundings = {},
                       const std::vector<std::uint8_t>& counted = {});

}  // namespace ibmfair
