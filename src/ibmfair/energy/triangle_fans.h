// Triangles in fans around a vertex, four fans of the same length side by side: the kernels take a
// triangle of each at a time. From one triangle of a fan to the next a single corner is new, and
// what is added to the corners that they share is added up before it goes to memory. Eight
// triangles with nothing in common took half as long again.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Triangles of a fan, at most: longer ones are cut.
inline constexpr Index longest_fan = 8;

/// Fans in a group: as many as a kernel takes at a time (base/lanes.h).
inline constexpr Index fans_per_group = 4;

/// Four fans. Their places are listed in rows of four, one for each fan: the centres, and then
/// the rims, each `triangles` + 1 vertices. Triangle i has the centre and the vertices i and i + 1
/// of the rim as its corners, in that order.
struct FanGroup {
  Index triangles = 0;           ///< in each of the fans
  std::int64_t first_place = 0;  ///< in the block's list
  std::int64_t first_row = 0;    ///< counts, over the groups before it, the vertices of a rim
};

/// A vector of space for each of the fans.
struct alignas(32) FanVectors {
  double x[fans_per_group], y[fans_per_group], z[fans_per_group];
};

/// What one loop over the triangles keeps for the next, of the triangle x0, x1, x2 with x0 at the
/// centre of each fan.
struct alignas(32) FanFrame {
  FanVectors p;  ///< x1 - x0, and x2 - x0 of the triangle before; behind the last one only this
  FanVectors n;  ///< half the unit normal
  double inverse[fans_per_group];  ///< 1 / (4 area)
};

/// Triangles as the numbers of their corners, or of those behind the edges opposite these.
using CornerTriples = std::vector<std::array<Index, 3>>;

/// Covers triangles with fans, block after block: what it keeps is only its memory.
class FanCover {
 public:
  /// Lists groups of fans in which each of the triangles is once, corners in the same circular
  /// order. Their vertices are less than `vertex_count`, and `place_of_vertex` times the vertex is
  /// its place. Where `beside` is not empty, a fan goes on only to the triangle that this names
  /// behind the edge. Fans that a group lacks are of the vertices 0, 1, 2, ...
  /// Linear in the number of triangles where few meet at a vertex.
  void append(const CornerTriples& triangles, const CornerTriples& beside, Index vertex_count,
              Index place_of_vertex, std::vector<Index>& places, std::vector<FanGroup>& groups);

  /// What the groups of the last append() hold, rows of four for the triangles of each: 3 times
  /// the triangle, and which of its corners is the centre, or -1 where the group lacks a fan.
  const std::vector<Index>& listed() const { return listed_; }

 private:
  /// A triangle as one of its corners sees it. `place` is 3 times the triangle and which of them.
  struct Corner {
    Index next, previous, place;

    Index triangle() const { return place / 3; }
  };

  struct Fan {
    Index centre = 0, length = 0;  // the latter in triangles
    std::array<Index, longest_fan + 1> rim;
    std::array<Index, longest_fan> places;  // of the triangles' corners
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

  std::vector<Index> first_;         // #V + 1, in corners_
  std::vector<Corner> corners_;      // by vertex
  std::vector<Index> left_;          // #V, triangles at the vertex that are in no fan yet
  std::vector<std::uint8_t> taken_;  // #F
  std::vector<std::uint8_t> met_;    // #V, for the walk from star to star
  std::vector<Index> queue_;         // of the same
  std::vector<Index> leaving_;       // #V, the corner of the current centre whose next it is, or -1
  std::vector<Index> after_;         // by corner: where a fan goes on from there, or -1
  std::vector<std::uint8_t> entered_;                     // by corner, whether a fan goes on there
  std::array<std::vector<Index>, longest_fan + 1> fans_;  // by length: the centre, the rim, and the
                                                          // places of the triangles' corners
  std::vector<Fan> rest_;  // what is left of those that fill no group
  std::vector<Index> listed_;
  const CornerTriples* beside_ = nullptr;  // in append()
};

}  // namespace ibmfair
