#include "ibmfair/energy/triangle_fans.h"

#include <algorithm>

#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {
namespace {

/// The number of values stored for a fan: L + 2 vertices and L triangles.
std::size_t size_of_fan(Index length) {
  return 2 * static_cast<std::size_t>(length) + 2;
}

}  // namespace

void FanCover::append(const CornerTriples& triangles, const CornerTriples& beside,
                      Index vertex_count, Index place_of_vertex, std::vector<Index>& places,
                      std::vector<FanGroup>& groups) {
  beside_ = &beside;
  find_stars(triangles, vertex_count);
  for (std::vector<Index>& fans : fans_) {
    fans.clear();
  }
  listed_.clear();
  take_whole_stars();
  take_what_is_left();
  cut_what_fills_no_group();
  std::size_t more_groups = 0, more_places = 0;
  for (Index length = longest_fan; length > 0; --length) {
    more_groups += groups_of(length);
    more_places += groups_of(length) * fans_per_group * (static_cast<std::size_t>(length) + 2);
  }
  groups.reserve(groups.size() + more_groups);
  places.reserve(places.size() + more_places);
  for (Index length = longest_fan; length > 0; --length) {
    append_groups(length, place_of_vertex, places, groups);
  }
}

/// Sorts the triangles' corners by vertex. Each corner is stored together with the two others, in
/// memory that is reused: with positions_by_value, setting up the energy of a large mesh would take
/// a third longer.
void FanCover::find_stars(const CornerTriples& triangles, Index vertex_count) {
  const auto vertices = static_cast<std::size_t>(vertex_count);
  left_.assign(vertices, 0);
  taken_.assign(triangles.size(), 0);
  met_.assign(vertices, 0);
  leaving_.assign(vertices, -1);
  for (const auto& x : triangles) {
    for (const Index v : x) {
      ++left_[v];
    }
  }
  first_.resize(vertices + 1);
  first_[0] = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    first_[v + 1] = first_[v] + left_[v];
  }
  corners_.resize(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto place = static_cast<Index>(3 * t);
    corners_[first_[a]++] = {b, c, place};
    corners_[first_[b]++] = {c, a, place + 1};
    corners_[first_[c]++] = {a, b, place + 2};
  }
  after_.resize(corners_.size());
  entered_.resize(corners_.size());
  for (std::size_t v = vertices; v > 0; --v) {  // each entry is now the start of the next vertex
    first_[v] = first_[v - 1];
  }
  first_[0] = 0;
}

/// Takes stars that have no triangle in common. The next star is sought across the edges of a
/// star's rim: if six triangles meet at every vertex, the stars found in this way leave no gaps,
/// whereas others would.
void FanCover::take_whole_stars() {
  constexpr Index worth_taking = 5;  // fans of the rest are hardly shorter than smaller stars
  for (Index seed = 0; seed < static_cast<Index>(left_.size()); ++seed) {
    if (met_[seed] != 0) {
      continue;
    }
    queue_.assign(1, seed);
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const Index v = queue_[i];
      if (left_[v] < worth_taking || left_[v] != first_[v + 1] - first_[v]) {
        continue;
      }
      take(v);
      for (const Corner& of_v : star(v)) {
        for (const Corner& across : star(of_v.previous)) {
          if (across.next == of_v.next && met_[across.previous] == 0) {
            met_[across.previous] = 1;
            queue_.push_back(across.previous);
          }
        }
      }
    }
  }
}

void FanCover::take_what_is_left() {
  for (Index enough = 5; enough > 0; --enough) {
    for (Index v = 0; v < static_cast<Index>(left_.size()); ++v) {
      if (left_[v] >= enough) {
        take(v);
      }
    }
  }
}

/// Whether a fan may continue from `from` to `to`. The edge between the two triangles is opposite
/// the corner `next` of `from`.
bool FanCover::goes_on(const Corner& from, const Corner& to) const {
  if (beside_->empty()) {
    return true;
  }
  const Index next = from.place % 3 < 2 ? from.place % 3 + 1 : 0;
  return (*beside_)[from.triangle()][next] == to.triangle();
}

/// Makes fans of all triangles at the centre that are in no fan yet.
void FanCover::take(Index centre) {
  const Index first = first_[centre], last = first_[centre + 1];
  for (Index c = first; c < last; ++c) {
    entered_[c] = 0;
    if (taken_[corners_[c].triangle()] == 0) {
      leaving_[corners_[c].next] = c;
    }
  }
  for (Index c = first; c < last; ++c) {
    const Index after = leaving_[corners_[c].previous];
    after_[c] = after >= 0 && goes_on(corners_[c], corners_[after]) ? after : -1;
    if (after_[c] >= 0 && taken_[corners_[c].triangle()] == 0) {
      entered_[after] = 1;
    }
  }
  for (Index c = first; c < last; ++c) {
    if (entered_[c] == 0) {
      take_from(c, centre);
    }
  }
  for (Index c = first; left_[centre] > 0 && c < last; ++c) {  // closed fans, and cut ones
    take_from(c, centre);
  }
  for (Index c = first; c < last; ++c) {
    leaving_[corners_[c].next] = -1;
  }
}

/// Makes a fan that begins with this corner, unless its triangle is already in a fan.
void FanCover::take_from(Index corner, Index centre) {
  Fan fan;
  fan.centre = centre;
  fan.rim[0] = corners_[corner].next;
  while (corner >= 0 && taken_[corners_[corner].triangle()] == 0 && fan.length < longest_fan) {
    const Corner& of_centre = corners_[corner];
    taken_[of_centre.triangle()] = 1;
    --left_[centre];
    --left_[of_centre.next];
    --left_[of_centre.previous];
    fan.places[fan.length] = of_centre.place;
    fan.rim[++fan.length] = of_centre.previous;
    corner = after_[corner];
  }
  if (fan.length > 0) {
    list_end(fan, fan.length);
  }
}

/// Lists the last `length` triangles of the fan as a fan of this length.
void FanCover::list_end(const Fan& fan, Index length) {
  std::vector<Index>& fans = fans_[length];
  const auto rim = fan.rim.begin() + (fan.length - length);
  const auto places = fan.places.begin() + (fan.length - length);
  fans.push_back(fan.centre);
  fans.insert(fans.end(), rim, rim + length + 1);
  fans.insert(fans.end(), places, places + length);
}

/// An incomplete group takes as long as a full one. The fans of all lengths that fill no group are
/// therefore cut into pieces that fill groups, or nearly.
void FanCover::cut_what_fills_no_group() {
  for (Index length = 1; length <= longest_fan; ++length) {
    std::vector<Index>& fans = fans_[length];
    const std::size_t size = size_of_fan(length);
    const std::size_t in_groups = fans.size() - fans.size() % (fans_per_group * size);
    for (std::size_t first = in_groups; first < fans.size(); first += size) {
      Fan fan;
      fan.centre = fans[first];
      fan.length = length;
      std::copy_n(&fans[first + 1], length + 1, fan.rim.begin());
      std::copy_n(&fans[first + length + 2], length, fan.places.begin());
      rest_.push_back(fan);
    }
    fans.resize(in_groups);
  }
  while (!rest_.empty()) {
    cut_pieces(best_length_of_pieces());
    std::erase_if(rest_, [](const Fan& rest) { return rest.length == 0; });
  }
}

/// The length of pieces for which the next group takes the least time per triangle.
Index FanCover::best_length_of_pieces() const {
  constexpr double besides = 1.5;  // overhead of a fan, relative to the time for one triangle
  Index best = 1;
  double most = 0;
  for (Index length = 1; length <= longest_fan; ++length) {
    Index pieces = 0;
    for (const Fan& rest : rest_) {
      pieces += rest.length / length;
    }
    const double done = length * std::min(pieces, fans_per_group) / (length + besides);
    if (done >= most) {
      most = done;
      best = length;
    }
  }
  return best;
}

/// Cuts up to one group of pieces of this length.
void FanCover::cut_pieces(Index length) {
  Index wanted = fans_per_group;
  for (Fan& rest : rest_) {
    for (; rest.length >= length && wanted > 0; --wanted) {
      list_end(rest, length);
      rest.length -= length;
    }
  }
}

/// The number of groups that the fans of this length fill.
std::size_t FanCover::groups_of(Index length) const {
  const std::size_t fans = fans_[length].size() / size_of_fan(length);
  return (fans + fans_per_group - 1) / fans_per_group;
}

/// Adjacent fans follow each other in the list. They are put into different groups, so that a sum
/// stored by one group has reached memory before the next group adds to it; but into groups close
/// to each other, so that the sum is still in the cache.
void FanCover::append_groups(Index length, Index place_of_vertex, std::vector<Index>& places,
                             std::vector<FanGroup>& groups) {
  constexpr std::size_t near = 8;
  const std::vector<Index>& fans = fans_[length];
  const auto vertices = static_cast<std::size_t>(length) + 2;
  const std::size_t size = size_of_fan(length);
  const std::size_t fan_count = fans.size() / size, group_count = groups_of(length);
  for (std::size_t g = 0; g < group_count; ++g) {
    FanGroup group{length, static_cast<std::int64_t>(places.size()), 0};
    if (!groups.empty()) {
      group.first_row = groups.back().first_row + groups.back().triangles + 1;
    }
    groups.push_back(group);
    places.resize(places.size() + vertices * fans_per_group);
    listed_.resize(listed_.size() + (size - vertices) * fans_per_group);
    Index* place = &places[group.first_place];
    Index* triangle = listed_.data() + listed_.size() - (size - vertices) * fans_per_group;
    const std::size_t first_near = g / near * near;
    const std::size_t distance = std::min(near, group_count - first_near);
    const auto fan_in = [&](std::size_t lane) {
      return fans_per_group * first_near + lane * distance + (g - first_near);
    };
    for (std::size_t i = 0; i < vertices; ++i) {
      for (std::size_t lane = 0; lane < fans_per_group; ++lane) {
        const std::size_t fan = fan_in(lane);
        *place++ = place_of_vertex * (fan < fan_count ? fans[size * fan + i] : Index(i));
      }
    }
    for (std::size_t i = vertices; i < size; ++i) {
      for (std::size_t lane = 0; lane < fans_per_group; ++lane) {
        const std::size_t fan = fan_in(lane);
        *triangle++ = fan < fan_count ? fans[size * fan + i] : -1;
      }
    }
  }
}

}  // namespace ibmfair
