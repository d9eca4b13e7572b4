#include "ibmfair/fill/split_hole.h"

#include <algorithm>
#include <unordered_map>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/fill/hole_triangulation.h"
#include "ibmfair/fill/sheet_border.h"
#include "ibmfair/mesh/corners.h"

namespace ibmfair {
namespace {

using Kind = SheetSide::Kind;

// Two strips beyond creases that meet in a corner share a vertex there if the creases turn by less
// than this to the left; if they turn by more than a right angle, a vertex lies between the strips.
constexpr double turn_of_shared_strip = radians(20.0);
constexpr double turn_of_gap = radians(91.0);

Index local_vertex(const Patch& patch, Index mesh_vertex) {
  const auto it = std::ranges::lower_bound(patch.mesh_vertex, mesh_vertex);
  return static_cast<Index>(it - patch.mesh_vertex.begin());
}

Triangles as_triangles(const std::vector<Index>& corners) {
  return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3),
                                     3);
}

/// Cuts one sheet out.
class SheetCutter {
 public:
  /// `X`: of all numbered vertices. `on_curve`: the numbers of the vertices of each curve.
  SheetCutter(const Topology& topology, const Patch& plain, const CreasedRim& rim,
              const CreaseNetwork& network, const Points& X,
              const std::vector<std::vector<Index>>& on_curve)
      : topology_(topology), plain_(plain), rim_(rim), X_(X), on_curve_(on_curve), net_(network) {
    sheet_.patch.inner_spacing = plain.inner_spacing;
  }

  Sheet cut(const std::vector<SheetSide>& sides) {
    const std::vector<BorderCurve> curves = border_curves(rim_, net_, sides);
    normal_ = mean_normal(rim_, sides);
    std::size_t curve = 0;
    for (const SheetSide& side : sides) {
      if (side.kind == Kind::arc) {
        add_arc(side.number);
      } else {
        add_curve(curves[curve++]);
      }
    }
    add_strips(curves);
    finish();
    return std::move(sheet_);
  }

 private:
  Index vertex(Index number) {
    const auto [place, is_new] = local_.try_emplace(number, static_cast<Index>(positions_.size()));
    if (is_new) {
      positions_.emplace_back(X_.row(number));
      sheet_.number.push_back(number);
    }
    return place->second;
  }

  Index made_up(const Vec3& position) {
    positions_.push_back(position);
    sheet_.number.push_back(-1);
    return static_cast<Index>(positions_.size()) - 1;
  }

  void surround(Index a, Index b, Index c) {
    for (const Index v : {a, b, c}) {
      around_.push_back(v);
    }
  }

  void add_rim(Index a, Index b, Index mesh_triangle, const Vec3& apex) {
    sheet_.patch.rim.push_back({a, b, mesh_triangle});
    apex_.push_back(apex);
  }

  void add_arc(Index arc) {
    for (const Index t : rim_.arcs[arc].triangles) {
      for (const Index v : topology_.F.row(t)) {
        around_.push_back(vertex(local_vertex(plain_, v)));
      }
    }
    const std::size_t count = plain_.rim.size();
    const std::size_t next = static_cast<std::size_t>(arc) + 1 < rim_.ends.size() ? arc + 1 : 0;
    const std::size_t end = rim_.ends.empty() ? 0 : rim_.ends[next].rim_edge;
    std::size_t k = rim_.ends.empty() ? 0 : rim_.ends[arc].rim_edge;
    do {
      const RimEdge& edge = plain_.rim[k];
      const Vec3 a = X_.row(edge.a), b = X_.row(edge.b);
      Vec3 apex = (a + b) / 2 + (b - a).cross(normal_);
      if (!rim_.on_crease[k]) {
        apex = X_.row(local_vertex(
            plain_, opposite_vertex(topology_.F, edge.mesh_triangle, plain_.mesh_vertex[edge.a],
                                    plain_.mesh_vertex[edge.b])));
      }
      add_rim(vertex(edge.a), vertex(edge.b), edge.mesh_triangle, apex);
      k = k + 1 < count ? k + 1 : 0;
    } while (k != end);
  }

  void add_curve(const BorderCurve& curve) {
    std::vector<Index> numbers = on_curve_[curve.curve];
    if (curve.reversed) {
      std::ranges::reverse(numbers);
    }
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k) {
      add_rim(vertex(numbers[k]), vertex(numbers[k + 1]), -1,
              curve.beyond.row(static_cast<Eigen::Index>(k)));
      // The sheet on the other side might use the same chords of a crease.
      for (std::size_t i = k + 2; i < numbers.size(); ++i) {
        sheet_.patch.taken.add(vertex(numbers[k]), vertex(numbers[i]));
      }
    }
    lines_.push_back(std::move(numbers));
  }

  /// Adds the strips of made-up triangles, joined at corners to each other and at the rim to the
  /// triangles of the mesh.
  void add_strips(const std::vector<BorderCurve>& curves) {
    Index begin = -1;  // the vertex with which a strip begins, if the previous strip gives it
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const BorderCurve& curve = curves[i];
      const std::vector<Index>& line = lines_[i];
      const bool shares = curve.end_after < 0 && curve.turn < turn_of_shared_strip;
      Index beyond = begin >= 0 ? begin : made_up(curve.beyond.row(0));
      begin = -1;
      if (curve.end_before >= 0) {
        join_to_mesh(line.front(), rim_.ends[curve.end_before].last[0], beyond, true);
      }
      for (std::size_t k = 1; k < line.size(); ++k) {
        const Index next = made_up(shares && k + 1 == line.size()
                                       ? between(curve, curves[i + 1])
                                       : Vec3(curve.beyond.row(static_cast<Eigen::Index>(k))));
        surround(vertex(line[k]), vertex(line[k - 1]), beyond);
        surround(vertex(line[k]), beyond, next);
        beyond = next;
      }
      if (curve.end_after >= 0) {
        join_to_mesh(line.back(), rim_.ends[curve.end_after].last[1], beyond, false);
      } else {
        begin = shares ? beyond : join_at_corner(curve, curves[i + 1], line.back(), beyond);
      }
    }
  }

  /// The place beyond the corner at which one curve ends and the other begins.
  static Vec3 between(const BorderCurve& curve, const BorderCurve& next) {
    const Vec3 corner = curve.points.back().position;
    const Vec3 a = curve.beyond.bottomRows(1).transpose() - corner;
    const Vec3 b = next.beyond.row(0).transpose() - corner;
    return corner + (a + b).normalized() * (a.norm() + b.norm()) / 2;
  }

  /// Fills the gap between two strips at a corner. Returns the vertex with which the second begins.
  Index join_at_corner(const BorderCurve& curve, const BorderCurve& next, Index corner,
                       Index beyond) {
    const Index v = vertex(corner);
    if (curve.turn > turn_of_gap) {
      const Index middle = made_up(between(curve, next));
      surround(v, beyond, middle);
      beyond = middle;
    }
    const Index begin = made_up(next.beyond.row(0));
    surround(v, beyond, begin);
    return begin;
  }

  void join_to_mesh(Index end, Index last, Index beyond, bool at_begin) {
    if (last < 0) {
      return;  // the rim runs along the crease here
    }
    if (at_begin) {
      surround(beyond, vertex(end), vertex(last));
    } else {
      surround(vertex(end), beyond, vertex(last));
    }
  }

  void finish() {
    Patch& patch = sheet_.patch;
    const auto count = static_cast<Index>(positions_.size());
    patch.X.resize(count, 3);
    for (Index v = 0; v < count; ++v) {
      patch.X.row(v) = positions_[v];
      const Index number = sheet_.number[v];
      const bool is_mesh = number >= 0 && number < plain_.own_from;
      patch.mesh_vertex.push_back(is_mesh ? plain_.mesh_vertex[number] : -1);
    }
    patch.own_from = count;
    patch.surroundings = as_triangles(around_);
    patch.free.assign(positions_.size(), 0);
    mark_taken();
    measure_spacing();
    patch.net.append(triangulated());
  }

  /// Marks the edges of the mesh between vertices of the rim.
  void mark_taken() {
    for (const auto x : plain_.surroundings.rowwise()) {
      for (int i = 0; i < 3; ++i) {
        const auto a = local_.find(x[i]), b = local_.find(x[(i + 1) % 3]);
        if (a != local_.end() && b != local_.end() && plain_.taken.contains(x[i], x[(i + 1) % 3])) {
          sheet_.patch.taken.add(a->second, b->second);
        }
      }
    }
  }

  void measure_spacing() {
    std::vector<double> sum(positions_.size(), 0), edges(positions_.size(), 0);
    for (const RimEdge& edge : sheet_.patch.rim) {
      const double length = (positions_[edge.a] - positions_[edge.b]).norm();
      for (const Index v : {edge.a, edge.b}) {
        sum[v] += length;
        edges[v] += 1;
      }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      sheet_.patch.spacing.push_back(sum[v] / std::max(edges[v], 1.0));
    }
    sheet_.patch.wanted = sheet_.patch.spacing;
  }

  Triangles triangulated() const {
    const std::vector<RimEdge>& rim = sheet_.patch.rim;
    const auto n = static_cast<Eigen::Index>(rim.size());
    Points loop(n, 3), apex(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      loop.row(i) = positions_[rim[i].a];
      apex.row(i) = apex_[i];
    }
    Triangles F = triangulate_hole(loop, apex);
    if (F.rows() != n - 2) {
      throw BadMesh("a sheet between creases cannot be triangulated");
    }
    for (Index& corner : F.reshaped()) {
      corner = rim[corner].a;
    }
    return F;
  }

  const Topology& topology_;
  const Patch& plain_;
  const CreasedRim& rim_;
  const Points& X_;
  const std::vector<std::vector<Index>>& on_curve_;
  const CreaseNetwork& net_;
  Vec3 normal_ = Vec3::Zero();
  Sheet sheet_;
  std::unordered_map<Index, Index> local_;  // by number
  std::vector<Vec3> positions_, apex_;
  std::vector<Index> around_;              // corners of the surroundings
  std::vector<std::vector<Index>> lines_;  // numbers of the vertices along each curve
};

}  // namespace

SplitHole::SplitHole(const Topology& topology, const Patch& plain, const CreasedRim& rim,
                     const CreaseNetwork& network)
    : topology_(topology), plain_(plain), rim_(rim), network_(network) {
  std::vector<Vec3> inside = network.corners;
  const auto ends = static_cast<Index>(rim.ends.size());
  const auto number_of = [&](Index node) {
    return node < ends ? plain.rim[rim.ends[node].rim_edge].a : plain.own_from + node - ends;
  };
  for (const CreaseCurve& curve : network.curves) {
    std::vector<Index> numbers{number_of(curve.from)};
    for (std::size_t k = 1; k + 1 < curve.points.size(); ++k) {
      numbers.push_back(plain.own_from + static_cast<Index>(inside.size()));
      inside.push_back(curve.points[k].position);
    }
    numbers.push_back(number_of(curve.to));
    on_curve_.push_back(std::move(numbers));
  }
  crease_size_ = static_cast<Index>(inside.size());
  all_X_.resize(plain.own_from + crease_size_, 3);
  all_X_.topRows(plain.own_from) = plain.X.topRows(plain.own_from);
  for (Index v = 0; v < crease_size_; ++v) {
    all_X_.row(plain.own_from + v) = inside[v];
  }
}

Sheet SplitHole::cut(std::size_t i) const {
  return SheetCutter(topology_, plain_, rim_, network_, all_X_, on_curve_).cut(network_.sheets[i]);
}

Patch SplitHole::joined(const std::vector<Sheet>& sheets) const {
  Patch patch = plain_;
  patch.net = {};
  patch.protruding.clear();
  std::vector<Index> corners;
  auto size = static_cast<Index>(all_X_.rows());
  for (const Sheet& sheet : sheets) {
    for (Index t = 0; t < sheet.patch.net.size(); ++t) {
      for (const Index v : sheet.patch.net[t]) {
        corners.push_back(v < sheet.patch.own_from ? sheet.number[v]
                                                   : size + v - sheet.patch.own_from);
      }
    }
    size += sheet.patch.own_size();
  }
  patch.net.append(as_triangles(corners));
  patch.X.resize(size, 3);
  patch.X.topRows(all_X_.rows()) = all_X_;
  patch.free.assign(static_cast<std::size_t>(size), 1);
  std::fill_n(patch.free.begin(), plain_.own_from, 0);
  patch.spacing.resize(static_cast<std::size_t>(size), 0);
  auto row = static_cast<Index>(all_X_.rows());
  for (const Sheet& sheet : sheets) {
    const Patch& part = sheet.patch;
    patch.X.middleRows(row, part.own_size()) = part.X.bottomRows(part.own_size());
    for (Index v = 0; v < part.own_from; ++v) {
      if (sheet.number[v] >= plain_.own_from) {
        patch.spacing[sheet.number[v]] = part.spacing[v];
      }
    }
    std::copy(part.spacing.begin() + part.own_from, part.spacing.end(),
              patch.spacing.begin() + row);
    row += part.own_size();
  }
  patch.wanted = patch.spacing;
  for (const std::vector<Index>& line : on_curve_) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      patch.creases.add(line[k], line[k + 1]);
    }
  }
  std::vector<Index> around;
  for (const RimEdge& edge : patch.rim) {
    const auto star = topology_.stars[patch.mesh_vertex[edge.a]];
    around.insert(around.end(), star.begin(), star.end());
  }
  std::ranges::sort(around);
  around.erase(std::unique(around.begin(), around.end()), around.end());
  corners.clear();
  for (const Index t : around) {
    for (const Index v : topology_.F.row(t)) {
      corners.push_back(local_vertex(patch, v));
    }
  }
  patch.surroundings = as_triangles(corners);
  return patch;
}

}  // namespace ibmfair
