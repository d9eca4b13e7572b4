// Triangles in fans around a vertex. The kernels process four fans of equal length at a time, one
// triangle of each in every step. From one triangle of a fan to the next, only one corner is new,
// and contributions to the corners that the two triangles share are added in registers before they
// are stored. Processing eight unrelated triangles in this way took half as long again.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// The most triangles in a fan; longer fans are cut.
inline constexpr Index longest_fan = 8;

/// Fans in a group: as many as a kernel processes at a time (base/lanes.h).
inline constexpr Index fans_per_group = 4;

/// Four fans. The places of their vertices are listed in rows of four, one for each fan: first the
/// centres, then the rims of `triangles` + 1 vertices. The corners of triangle i are the centre and
/// the vertices i and i + 1 of the rim, in this order.
struct FanGroup {
  Index triangles = 0;           ///< in each of the fans
  std::int64_t first_place = 0;  ///< in the block's list
  std::int64_t first_row = 0;    ///< the sum of (triangles + 1) over all previous groups
};

/// A vector in space for each of the four fans.
struct alignas(32) FanVectors {
  double x[fans_per_group], y[fans_per_group], z[fans_per_group];
};

/// The data of a triangle x0, x1, x2, with x0 at the centre of its fan, that one loop over the
/// triangles keeps for the next loop.
struct alignas(32) FanFrame {
  FanVectors p;  ///< x1 - x0, which is x2 - x0 of the previous triangle; the frame behind the last
                 ///< triangle has only this
  FanVectors n;  ///< half the unit normal
  double inverse[fans_per_group];  ///< 1 / (4 area)
};

/// Triangles as triples of numbers: either their corners, or the triangles across the edges
/// opposite the corners.
using CornerTriples = std::vector<std::array<Index, 3>>;

/// Covers triangles with fans, block after block. The object keeps memory between the calls, but no
/// results besides listed().
class FanCover {
 public:
  /// Appends groups of fans that contain each triangle exactly once, its corners in the same cyclic
  /// order. Vertices are below `vertex_count`; the place of a vertex is `place_of_vertex` times its
  /// number. If `beside` is not empty, a fan continues across an edge only to the triangle that
  /// `beside` has for this edge. An incomplete group is filled with fans of the vertices 0, 1, 2,
  /// ... Linear in the number of triangles if few of them meet at each vertex.
  void append(const CornerTriples& triangles, const CornerTriples& beside, Index vertex_count,
              Index place_of_vertex, std::vector<Index>& places, std::vector<FanGroup>& groups);

  /// The triangles in the groups of the last append(), in rows of four, one for each fan: 3 times
  /// the triangle plus the number (0 .. 2) of the corner at the centre, or -1 for a fan that fills
  /// up a group.
  const std::vector<Index>& listed() const { return listed_; }

 private:
  /// A triangle as seen from one of its corners. `place` is 3 times the triangle plus the number of
  /// the corner.
  struct Corner {
    Index next, previous, place;

    Index triangle() const { return place / 3; }
  };

  struct Fan {
    Index centre = 0, length = 0;  // `length` in triangles
    std::array<Index, longest_fan + 1> rim;
    std::array<Index, longest_fan> places;  // Corner::place of each triangle
  };

  void find_stars(const CornerTriples& triangles, Index vertex_count);
  void take_whole_stars();
  void take_what_is_left();
  void take(Index centre);
  void take_from(Index corner, Index centre);
  bool goes_on(const Corner& from, const Corner& to) const;
  void cut_what_fills_no_group();
  Index best_length_of_pieces() const;
  void cut_pieces(Index length);
  void list_end(const Fan& fan, Index length);
  std::size_t groups_of(Index length) const;
  void append_groups(Index length, Index place_of_vertex, std::vector<Index>& places,
                     std::vector<FanGroup>& groups);

  std::span<const Corner> star(Index v) const {
    return {corners_.data() + first_[v], corners_.data() + first_[v + 1]};
  }

  std::vector<Index> first_;         // #V + 1, indices into corners_
  std::vector<Corner> corners_;      // sorted by vertex
  std::vector<Index> left_;          // #V, triangles at the vertex that are in no fan yet
  std::vector<std::uint8_t> taken_;  // #F
  std::vector<std::uint8_t> met_;    // #V, visited by the walk from star to star
  std::vector<Index> queue_;         // the queue of this walk
  // #V, the corner at the current centre with `next` equal to the vertex, or -1.
  std::vector<Index> leaving_;
  std::vector<Index> after_;           // by corner: the corner to which a fan continues, or -1
  std::vector<std::uint8_t> entered_;  // by corner: whether a fan continues to it
  // By length, for each fan: the centre, the rim, and the places of the triangles' corners.
  std::array<std::vector<Index>, longest_fan + 1> fans_;
  std::vector<Fan> rest_;  // fans left over because they fill no group
  std::vector<Index> listed_;
  const CornerTriples* beside_ = nullptr;  // valid during append() only
};

}  // namespace ibmfair
