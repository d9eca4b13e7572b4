// The triangles of a mesh as the kernels of the energies take them: block by block, in groups of
// four fans. A sum over the triangles around a vertex is added up in the block that
// owns the vertex, which computes every triangle there, also those that other blocks compute for
// their vertices. So no two threads write the same place, the order of every sum is fixed, and
// nothing per triangle is kept from one pass to the next.
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

/// What a block holds of a vertex: what is gathered from it, first of all its position, and what is
/// added to it. They share a cache line, in which the block has few enough to keep them at hand. In
/// arrays of their own the last 12 bits of their addresses would agree, and the processor take a
/// load of one for one that must wait for a store to the other.
struct alignas(64) BlockVertex {
  Row4 x, sum;
};
using BlockVertices = std::vector<BlockVertex>;

/// For each corner of each triangle (3 #F) the triangle behind the opposite edge: t, or ~t where
/// the orientations of the two disagree, or `no_triangle`.
using Neighbours = std::vector<Index>;
inline constexpr Index no_triangle = std::numeric_limits<Index>::max();

/// The first vertices of every block are those of a flat fan, which fills up groups.
inline constexpr Index filler_vertices = longest_fan + 2;

/// One block. Its vertices are the filler's, then those it owns, then the other corners of its
/// triangles.
struct MeshBlock {
  std::int64_t first_owned = 0;   ///< in MeshBlocks::owned
  Index owned = 0;                ///< vertices
  std::vector<Index> halo;        ///< the others, as the mesh numbers them
  Index rim = 0;                  ///< the first of these are corners of the first `groups`
  std::vector<FanGroup> fans;     ///< the groups
  std::vector<Index> corners;     ///< their places: `vertex_size` times the vertex
  std::vector<Index> neighbours;  ///< listed like these, for the first `groups`: the triangle
                                  ///< before the first of a fan, those behind its rim, and that
                                  ///< after the last, by `row_size` times their row. Triangle i of
                                  ///< a fan has row 4 (FanGroup::first_row + i) + the fan's place
                                  ///< in the group, and is itself where it has no neighbour
  std::int64_t own_groups = 0;    ///< those of the triangles that count, each in one block's
  std::int64_t groups = 0;        ///< and of all others at its own vertices
  std::int64_t outer_groups = 0;  ///< and of what is wanted around both
  std::vector<Index> lines;  ///< where Points keep the vertices' rows: cache lines, counted from
                             ///< the first row on, those of its own vertices first
  std::size_t own_line_count = 0;  ///< of these

  std::span<const Index> own_lines() const { return {lines.data(), own_line_count}; }
};

/// A loop over the first groups of a block, with a step of `fetch` after each.
struct BlockPass {
  const MeshBlock& block;
  std::int64_t groups = 0;
  BlockPrefetch fetch = {};
};

/// Numbers in what there is of a vertex.
inline constexpr Index vertex_size = sizeof(BlockVertex) / sizeof(double);

struct MeshBlocks {
  std::vector<MeshBlock> block;
  std::vector<Index> owned;      ///< the vertices of all blocks, as the mesh numbers them
  std::vector<Index> untouched;  ///< the vertices that have no triangle

  /// A block's own vertices, as the mesh numbers them.
  std::span<const Index> owned_of(const MeshBlock& b) const {
    return {owned.data() + b.first_owned, static_cast<std::size_t>(b.owned)};
  }

  /// Whether a loop over the blocks pays on all threads. Triangles are twice as many.
  bool are_worth_sharing() const {
    return 2 * static_cast<std::int64_t>(owned.size()) >= worth_sharing;
  }

  /// The positions of a block's vertices, x out of X (#V x 3), and sums of zero. The list may grow,
  /// but never shrinks, and has room for fans_per_group more.
  void load(const MeshBlock& b, const Points& X, BlockVertices& vertices) const;
  /// The fourth number of their x out of w (#V).
  void load(const MeshBlock& b, const PerVertex& w, BlockVertices& vertices) const;
  /// A block's sums to its own vertices in G (#V x 3).
  void store(const MeshBlock& b, const BlockVertices& vertices, Points& G) const;
  /// A loop that fetches the rows of G that the block will store.
  BlockPass fetching_sums(const MeshBlock& b, std::int64_t groups, const Points& G) const;
  /// A loop that fetches the rows of X of the next block, which most likely is the next one of this
  /// thread, too.
  BlockPass fetching_next(const MeshBlock& b, std::int64_t groups, const Points& X) const;
  /// Makes G #V x 3, zero where no block stores anything.
  void prepare(Points& G) const;
};

/// What blocks have besides the triangles at their own vertices.
struct BlockSurroundings {
  Neighbours neighbours = {};  ///< where given, the triangles next to those; these must be kept.
                               ///< Fans go on from one to the other only
  bool whole_stars = false;    ///< all that are kept around the corners of those
};

/// Blocks of the triangles that are `kept` (#F). Those that are not `counted` (#F, or empty for
/// all) are in no block's `own_groups`; with whole stars none is.
MeshBlocks mesh_blocks(const Topology& topology, const std::vector<std::uint8_t>& kept,
                       const BlockSurroundings& surroundings = {},
                       const std::vector<std::uint8_t>& counted = {});

}  // namespace ibmfair
