#include "ibmfair/fill/rim_creases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "ibmfair/base/angle.h"
#include "ibmfair/fill/sharp_lines.h"
#include "ibmfair/mesh/corners.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

constexpr std::size_t least_edges = 3;  // of a line that ends within a smooth part of the surface
constexpr double along_rim = radians(20.0);  // between a crease and a rim edge that continues it
constexpr std::size_t edges_for_normal = 3, most_points = 8;
constexpr double flat = radians(2.0);  // the largest angle of a flat sheet's triangles to its plane

/// The triangles around a vertex of the rim, from the rim edge before it to the one after it.
struct Fan {
  std::vector<Index> triangles;
  std::vector<Index> spokes;           // the vertices between them, one fewer
  std::vector<std::uint8_t> is_sharp;  // per spoke
  bool is_whole = true;                // false at defects: the fan ends before the rim is reached
};

class RimCreases {
 public:
  RimCreases(const Points& X, const Topology& topology, const std::vector<RimEdge>& rim,
             const std::vector<Index>& mesh_vertex, double angle)
      : X_(X),
        topology_(topology),
        edges_(rim),
        mesh_vertex_(mesh_vertex),
        lines_(X, topology, angle),
        angle_(angle) {
    for (const RimEdge& edge : rim) {
      rim_.push_back(mesh_vertex[edge.a]);
    }
    result_.on_crease.assign(rim_.size(), 0);
  }

  CreasedRim find() {
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      fans_.push_back(fan(k));
      find_line(k);
    }
    for (const auto& [k, chain] : chains_) {
      advance(k, chain);
    }
    std::erase_if(ends_, [this](const auto& end) { return lies_along_rim(end.first); });
    add_meeting_sheets();
    for (const auto& [k, chain] : ends_) {
      result_.ends.push_back(end_at(k, chain));
    }
    for (std::size_t i = 0; i < std::max<std::size_t>(result_.ends.size(), 1); ++i) {
      result_.arcs.push_back(arc_from(i));
    }
    return std::move(result_);
  }

 private:
  using Chain = std::vector<Index>;  // mesh vertices, from the rim on; of one vertex if unknown

  std::size_t next(std::size_t k) const { return k + 1 < rim_.size() ? k + 1 : 0; }
  std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : rim_.size() - 1; }
  Vec3 at(Index v) const { return X_.row(v); }
  Vec3 area_vector(Index t) const { return double_area_vector(X_, topology_.F, t); }

  Fan fan(std::size_t k) const {
    Fan result;
    const Index v = rim_[k], end = rim_[next(k)], last = edges_[k].mesh_triangle;
    Index t = edges_[previous(k)].mesh_triangle, u = rim_[previous(k)];
    while (true) {
      result.triangles.push_back(t);
      const Index w = opposite_vertex(topology_.F, t, v, u);
      if (t == last && w == end) {
        return result;
      }
      const Index beyond = lines_.beyond(t, v, w);
      if (beyond < 0 || result.triangles.size() > topology_.stars[v].size()) {
        result.is_whole = false;
        return result;
      }
      result.spokes.push_back(w);
      result.is_sharp.push_back(0);
      u = w;
      t = beyond;
    }
  }

  /// Marks the creases among the spokes of a fan, and notes a single one as a crease that ends
  /// here.
  void find_line(std::size_t k) {
    Fan& fan = fans_[k];
    Chain chain;
    int count = 0;
    for (std::size_t i = 0; fan.is_whole && i < fan.spokes.size(); ++i) {
      if (!lines_.turns(fan.triangles[i], fan.triangles[i + 1])) {
        continue;
      }
      const SharpLine line = lines_.follow(rim_[k], fan.spokes[i]);
      if (line.ends_well || line.vertices.size() > least_edges) {
        fan.is_sharp[i] = 1;
        chain = line.vertices;
        ++count;
      }
    }
    if (count == 1) {
      chains_[k] = chain;
    }
  }

  /// Whether both rim edges at this place lie on creases.
  bool lies_along_rim(std::size_t k) const {
    return result_.on_crease[k] && result_.on_crease[previous(k)];
  }

  /// Follows a crease that goes on along the rim to the vertex where it leaves the rim. A crease
  /// that comes to the end of another goes no farther.
  void advance(std::size_t k, Chain chain) {
    CreaseEnd start;
    start.curve.direction = direction_of(chain);
    set_normals(chain, start);
    for (std::size_t step = 0; step < rim_.size(); ++step) {
      const Vec3 direction = direction_of(chain);
      const auto continues = [&](std::size_t to) {
        return angle_between(direction, at(rim_[to]) - at(rim_[k])) < along_rim;
      };
      const int side = continues(next(k)) ? 0 : 1;  // the side of the crease on which the hole lies
      const std::size_t to = side == 0 ? next(k) : previous(k), edge = side == 0 ? k : to;
      if (!continues(to)) {
        ends_[k] = chain;
        return;
      }
      if (result_.on_crease[edge]) {
        return;  // two creases are one
      }
      result_.on_crease[edge] = 1;
      normal_beside_[edge] = start.normal[side];
      chain.insert(chain.begin(), rim_[to]);
      chain.resize(std::min(chain.size(), most_points));
      k = to;
      if (chains_.contains(k)) {
        return;
      }
    }
  }

  Vec3 direction_of(const Chain& chain) const {
    std::vector<Vec3> points;
    for (const Index v : chain) {
      points.push_back(at(v));
    }
    return end_of_polyline(points).direction;
  }

  /// The triangles of a sheet at a vertex of the rim: those from the rim edge before it (side 0) or
  /// after it (side 1) to the first crease.
  std::vector<Index> part(std::size_t k, int side, Index* last = nullptr) const {
    std::vector<Index> triangles = fans_[k].triangles, spokes = fans_[k].spokes;
    std::vector<std::uint8_t> is_sharp = fans_[k].is_sharp;
    if (!fans_[k].is_whole) {
      return {};
    }
    if (side == 1) {
      std::ranges::reverse(triangles);
      std::ranges::reverse(spokes);
      std::ranges::reverse(is_sharp);
    }
    const auto crease = std::ranges::find(is_sharp, 1) - is_sharp.begin();
    if (last != nullptr) {
      const Index beyond = rim_[side == 0 ? next(k) : previous(k)];
      *last = crease < std::ssize(spokes) ? spokes[crease] : beyond;
    }
    triangles.resize(std::min<std::size_t>(triangles.size(), crease + 1));
    return triangles;
  }

  Vec3 normal_of(const std::vector<Index>& triangles) const {
    Vec3 sum = Vec3::Zero();
    for (const Index t : triangles) {
      sum += area_vector(t);
    }
    return sum.normalized();
  }

  /// Adds ends at vertices where several creases meet and two sheets go on into the hole.
  void add_meeting_sheets() {
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      const auto count = std::ranges::count(fans_[k].is_sharp, 1);
      const bool is_along = result_.on_crease[k] || result_.on_crease[previous(k)];
      if (ends_.contains(k) || (is_along ? !lies_along_rim(k) : count < 2)) {
        continue;
      }
      if (angle_between(sheet_normal(k, 0), sheet_normal(k, 1)) > angle_) {
        ends_[k] = {rim_[k]};
      }
    }
  }

  /// The normal of the sheet in the hole at the rim edge before (side 0) or after a vertex.
  Vec3 sheet_normal(std::size_t k, int side) const {
    const auto beside = normal_beside_.find(side == 0 ? previous(k) : k);
    return beside != normal_beside_.end() ? beside->second : normal_of(part(k, side));
  }

  /// The normals of both sheets beside the last edges of a crease. The sheets' directions across
  /// the crease are averaged: they do not depend on how the crease bends.
  void set_normals(const Chain& chain, CreaseEnd& end) const {
    std::array<Vec3, 2> left{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t i = 0; i + 1 < chain.size() && i < edges_for_normal; ++i) {
      const Index near = chain[i], far = chain[i + 1];
      for (const Index t : topology_.stars[near]) {
        if ((topology_.F.row(t).array() == far).any()) {
          const int side = runs_along(topology_.F, t, far, near) ? 0 : 1;
          left[side] += area_vector(t).cross(at(near) - at(far)).normalized();
        }
      }
    }
    for (int side = 0; side < 2; ++side) {
      if (left[side] != Vec3::Zero()) {
        end.normal[side] = end.curve.direction.cross(left[side]).normalized();
      }
    }
  }

  CreaseEnd end_at(std::size_t k, const Chain& chain) const {
    CreaseEnd end;
    end.rim_edge = k;
    end.curve.position = at(rim_[k]);
    for (int side = 0; side < 2; ++side) {
      Index last = -1;
      part(k, side, &last);
      end.normal[side] = sheet_normal(k, side);
      const auto edge = side == 0 ? previous(k) : k;
      end.last[side] = result_.on_crease[edge] || last < 0 ? -1 : local(last);
    }
    if (chain.size() > 1) {
      std::vector<Vec3> points;
      for (const Index v : chain) {
        points.push_back(at(v));
      }
      end.curve = end_of_polyline(points);
      set_normals(chain, end);
      return end;
    }
    const Vec3 t = end.normal[0].cross(end.normal[1]).normalized();
    const double inward = end.normal[0].cross(t).dot(at(rim_[previous(k)]) - at(rim_[k])) -
                          end.normal[1].cross(t).dot(at(rim_[next(k)]) - at(rim_[k]));
    end.curve.direction = inward > 0 ? t : Vec3(-t);
    return end;
  }

  Index local(Index v) const {
    const auto it = std::ranges::lower_bound(mesh_vertex_, v);
    return static_cast<Index>(it - mesh_vertex_.begin());
  }

  RimArc arc_from(std::size_t i) const {
    RimArc arc;
    const std::vector<CreaseEnd>& ends = result_.ends;
    const std::size_t end = ends.empty() ? 0 : ends[i + 1 < ends.size() ? i + 1 : 0].rim_edge;
    std::size_t k = ends.empty() ? 0 : ends[i].rim_edge;
    do {
      if (!result_.on_crease[k]) {
        for (const auto& [vertex, side] : {std::pair(k, 1), std::pair(next(k), 0)}) {
          const std::vector<Index> some = part(vertex, side);
          arc.triangles.insert(arc.triangles.end(), some.begin(), some.end());
        }
      }
      k = next(k);
    } while (k != end);
    std::ranges::sort(arc.triangles);
    arc.triangles.erase(std::unique(arc.triangles.begin(), arc.triangles.end()),
                        arc.triangles.end());
    arc.normal = normal_of(arc.triangles);
    arc.plane = plane_of(arc.triangles);
    return arc;
  }

  std::optional<SheetPlane> plane_of(const std::vector<Index>& triangles) const {
    SheetPlane plane{Vec3::Zero(), normal_of(triangles)};
    for (const Index t : triangles) {
      if (!(angle_between(area_vector(t), plane.normal) < flat)) {
        return std::nullopt;
      }
      for (const Index v : topology_.F.row(t)) {
        plane.point += at(v) / (3.0 * static_cast<double>(triangles.size()));
      }
    }
    return triangles.empty() ? std::nullopt : std::optional(plane);
  }

  const Points& X_;
  const Topology& topology_;
  const std::vector<RimEdge>& edges_;
  const std::vector<Index>& mesh_vertex_;
  const SharpLines lines_;
  const double angle_;
  std::vector<Index> rim_;  // mesh vertices; edge k of the rim begins at vertex k
  std::vector<Fan> fans_;
  std::map<std::size_t, Chain> chains_;        // by their place on the rim, as found
  std::map<std::size_t, Chain> ends_;          // the same, where they leave the rim
  std::map<std::size_t, Vec3> normal_beside_;  // of the hole's sheet at rim edges on creases
  CreasedRim result_;
};

}  // namespace

CreasedRim find_rim_creases(const Points& X, const Topology& topology,
                            const std::vector<RimEdge>& rim, const std::vector<Index>& mesh_vertex,
                            double angle) {
  return RimCreases(X, topology, rim, mesh_vertex, angle).find();
}

void remove_end(Index end, CreasedRim& rim) {
  if (rim.ends.size() > 1) {
    RimArc& before = rim.arcs[end > 0 ? end - 1 : std::ssize(rim.arcs) - 1];
    const RimArc& after = rim.arcs[end];
    before.triangles.insert(before.triangles.end(), after.triangles.begin(), after.triangles.end());
    std::ranges::sort(before.triangles);
    before.triangles.erase(std::unique(before.triangles.begin(), before.triangles.end()),
                           before.triangles.end());
    before.normal = (before.normal + after.normal).normalized();
    before.plane.reset();
    rim.arcs.erase(rim.arcs.begin() + end);
  }
  rim.ends.erase(rim.ends.begin() + end);
}

}  // namespace ibmfair
