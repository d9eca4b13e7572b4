#include "ibmfair/fill/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "ibmfair/io/weld.h"
#include "ibmfair/mesh/box_grid.h"
#include "ibmfair/mesh/union_find.h"

namespace ibmfair {
namespace {

constexpr double usual_reach = 1e-3;   // in lengths of the shortest boundary edge at a vertex
constexpr double largest_reach = 0.3;  // so that the two ends of an edge never coincide

constexpr double endless = std::numeric_limits<double>::infinity();

/// A directed edge of a boundary loop.
struct LoopEdge {
  Index a, b, hole;
  double length;
};

/// A vertex inside an edge, at this share of the way from a to b.
struct Junction {
  Index edge, vertex;
  double along;

  auto order() const { return std::tuple(edge, along, vertex); }
};

/// A part of an edge between two neighbouring vertices on it.
struct Piece {
  Index low, high;    // the places of the two vertices, the smaller number first
  Index edge;         // number of the edge
  Index first, last;  // the vertices, so that `first` is at `low`
};

std::vector<LoopEdge> edges_of(const Points& X, const std::vector<Hole>& holes) {
  std::vector<LoopEdge> edges;
  for (const Hole& hole : holes) {
    const auto n = static_cast<Index>(hole.loop.size());
    for (Index i = 0; i < hole.edges(); ++i) {
      const Index a = hole.loop[i], b = hole.loop[(i + 1) % n];
      edges.push_back({a, b, hole.id, (X.row(a) - X.row(b)).norm()});
    }
  }
  return edges;
}

void make_unique(std::vector<Index>& values) {
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values);
  values.erase(repeated.begin(), repeated.end());
}

/// Whether the vertex is a corner of the triangle behind a boundary edge.
bool is_behind(const Topology& topology, Index vertex, const LoopEdge& edge) {
  return std::ranges::any_of(topology.stars[vertex], [&](Index t) {
    const auto x = topology.F.row(t).array();
    return (x == edge.a).any() && (x == edge.b).any();
  });
}

class CrackSearch {
 public:
  CrackSearch(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
              std::optional<double> reach)
      : X_(X),
        topology_(topology),
        edges_(edges_of(X, holes)),
        places_(topology.vertex_count),
        merged_(topology.vertex_count) {
    result_.loops.resize(holes.size());
    find_reaches(reach);
    find_contacts();
    if (!any_contact_) {
      return;
    }
    choose_junctions();
    match();
    describe(holes);
  }

  Cracks result() { return std::move(result_); }

 private:
  void find_reaches(std::optional<double> reach) {
    reach_.assign(static_cast<std::size_t>(topology_.vertex_count), endless);
    for (const LoopEdge& edge : edges_) {
      const double own =
          reach ? std::min(*reach, largest_reach * edge.length) : usual_reach * edge.length;
      reach_[edge.a] = std::min(reach_[edge.a], own);
      reach_[edge.b] = std::min(reach_[edge.b], own);
    }
  }

  /// Finds vertices that coincide, and vertices inside edges.
  void find_contacts() {
    std::vector<BoxGrid::Box> boxes;
    boxes.reserve(edges_.size());
    for (const LoopEdge& edge : edges_) {
      boxes.emplace_back(Vec3(X_.row(edge.a)));
      boxes.back().extend(Vec3(X_.row(edge.b)));
    }
    const BoxGrid grid(std::move(boxes));
    std::vector<Index> near;
    for (const Index v : places_on_rims()) {
      const Vec3 x = X_.row(v), margin = Vec3::Constant(reach_[v]);
      grid.find({x - margin, x + margin}, near);
      for (const Index e : near) {
        if (edges_[e].a != v && edges_[e].b != v) {
          meet(v, e);
        }
      }
    }
  }

  /// The vertices of the loops; of those with equal coordinates the first, which is joined to the
  /// others and gets the smallest of their reaches.
  std::vector<Index> places_on_rims() {
    std::vector<Index> vertices;
    for (const LoopEdge& edge : edges_) {
      vertices.insert(vertices.end(), {edge.a, edge.b});
    }
    make_unique(vertices);
    const Weld weld = find_coincident_vertices(X_(vertices, Eigen::all));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Index first = vertices[weld.first[weld.vertex[i]]];
      any_contact_ = any_contact_ || first != vertices[i];
      places_.unite(first, vertices[i]);
      reach_[first] = std::min(reach_[first], reach_[vertices[i]]);
    }
    std::vector<Index> places;
    for (const Index i : weld.first) {
      places.push_back(vertices[i]);
    }
    return places;
  }

  bool coincide(Index v, Index w) const {
    return (X_.row(v) - X_.row(w)).norm() <= std::min(reach_[v], reach_[w]);
  }

  void meet(Index v, Index e) {
    const LoopEdge& edge = edges_[e];
    if (coincide(v, edge.a) || coincide(v, edge.b)) {
      places_.unite(v, coincide(v, edge.a) ? edge.a : edge.b);
      any_contact_ = true;
      return;
    }
    const Vec3 d = X_.row(v) - X_.row(edge.a), along = X_.row(edge.b) - X_.row(edge.a);
    const double share = d.dot(along) / along.squaredNorm();
    if (share > 0 && share < 1 &&
        (d - share * along).norm() <= std::min({reach_[v], reach_[edge.a], reach_[edge.b]}) &&
        !is_behind(topology_, v, edge)) {
      junctions_.push_back({e, v, share});
      any_contact_ = true;
    }
  }

  /// Leaves out junctions that close nothing, until there are none.
  void choose_junctions() {
    std::erase_if(junctions_, [&](const Junction& junction) {
      const LoopEdge& edge = edges_[junction.edge];
      const Index place = places_.find(junction.vertex);
      return place == places_.find(edge.a) || place == places_.find(edge.b);
    });
    std::ranges::sort(junctions_, {}, &Junction::order);
    const auto repeated =
        std::ranges::unique(junctions_, [&](const Junction& j, const Junction& k) {
          return j.edge == k.edge && places_.find(j.vertex) == places_.find(k.vertex);
        });
    junctions_.erase(repeated.begin(), repeated.end());
    for (bool again = true; again;) {
      find_pieces();
      std::vector<Junction> kept;
      for (std::size_t j = 0; j < junctions_.size(); ++j) {
        // Piece j + e ends at junction j of edge e, and the next piece begins there.
        const std::size_t before = j + static_cast<std::size_t>(junctions_[j].edge);
        if (partner_[before] >= 0 || partner_[before + 1] >= 0) {
          kept.push_back(junctions_[j]);
        }
      }
      again = kept.size() < junctions_.size();
      junctions_ = std::move(kept);
    }
  }

  /// Cuts the edges at the junctions, and finds for each piece the other piece that lies on it.
  void find_pieces() {
    pieces_.clear();
    auto junction = junctions_.begin();
    for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e) {
      Index from = edges_[e].a;
      for (; junction != junctions_.end() && junction->edge == e; ++junction) {
        add_piece(e, from, junction->vertex);
        from = junction->vertex;
      }
      add_piece(e, from, edges_[e].b);
    }
    std::vector<Index> order(pieces_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = static_cast<Index>(i);
    }
    const auto ends = [&](Index i) { return std::pair(pieces_[i].low, pieces_[i].high); };
    std::ranges::sort(
        order, [&](Index i, Index j) { return std::pair(ends(i), i) < std::pair(ends(j), j); });
    partner_.assign(pieces_.size(), -1);
    for (auto first = order.begin(); first != order.end();) {
      const auto last =
          std::find_if(first, order.end(), [&](Index i) { return ends(i) != ends(*first); });
      if (last - first == 2 && pieces_[*first].low != pieces_[*first].high &&
          pieces_[*first].edge != pieces_[*(first + 1)].edge) {
        partner_[*first] = *(first + 1);
        partner_[*(first + 1)] = *first;
      }
      first = last;
    }
  }

  void add_piece(Index edge, Index from, Index to) {
    const Index start = places_.find(from), end = places_.find(to);
    pieces_.push_back(start <= end ? Piece{start, end, edge, from, to}
                                   : Piece{end, start, edge, to, from});
  }

  /// Merges the ends of pieces that lie on each other.
  void match() {
    std::vector<Index> vertices;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (partner_[i] < 0) {
        continue;
      }
      const Piece &piece = pieces_[i], &other = pieces_[partner_[i]];
      merged_.unite(piece.first, other.first);
      merged_.unite(piece.last, other.last);
      vertices.insert(vertices.end(), {piece.first, piece.last});
    }
    make_unique(vertices);
    for (const Index v : vertices) {
      if (const Index first = merged_.find(v); first != v) {
        result_.merged.push_back({first, v});
        result_.farthest = std::max(result_.farthest, (X_.row(first) - X_.row(v)).norm());
      }
    }
    for (const Junction& junction : junctions_) {
      const LoopEdge& edge = edges_[junction.edge];
      auto& splits = result_.splits;
      if (splits.empty() || splits.back().a != edge.a || splits.back().b != edge.b) {
        splits.push_back({edge.a, edge.b, {}});
      }
      splits.back().vertices.push_back(junction.vertex);
    }
  }

  void describe(const std::vector<Hole>& holes) {
    std::vector<std::uint8_t> open(edges_.size(), 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      LoopCrack& loop = result_.loops[edges_[piece.edge].hole];
      if (partner_[i] < 0) {
        open[piece.edge] = 1;
        continue;
      }
      loop.kind = LoopKind::partial_crack;
      const Piece& other = pieces_[partner_[i]];
      name_junction(other.edge, loop);
      for (const auto& [v, w] :
           {std::pair(piece.first, other.first), std::pair(piece.last, other.last)}) {
        loop.exact = loop.exact && X_.row(v) == X_.row(w);
      }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      result_.loops[edges_[e].hole].edges += open[e] ? 0 : 1;
    }
    for (const Junction& junction : junctions_) {
      const LoopEdge& edge = edges_[junction.edge];
      LoopCrack& loop = result_.loops[edge.hole];
      ++loop.t_junctions;
      name_junction(junction.edge, loop);
    }
    for (const Hole& hole : holes) {
      LoopCrack& loop = result_.loops[hole.id];
      if (loop.kind == LoopKind::partial_crack && loop.edges == hole.edges()) {
        loop.kind = LoopKind::crack;
      }
    }
  }

  /// Names a junction on the edge as the example of the loop, if there is one and the loop has
  /// none.
  void name_junction(Index e, LoopCrack& loop) const {
    const auto first = std::ranges::lower_bound(junctions_, e, {}, &Junction::edge);
    if (loop.t_junction[0] < 0 && first != junctions_.end() && first->edge == e) {
      loop.t_junction = {first->vertex, edges_[e].a, edges_[e].b};
    }
  }

  const Points& X_;
  const Topology& topology_;
  std::vector<LoopEdge> edges_;
  std::vector<double> reach_;        // #V; infinite for vertices on no loop
  UnionFind places_;                 // vertices that coincide
  UnionFind merged_;                 // of these, vertices of edges that lie on each other
  std::vector<Junction> junctions_;  // sorted by their edges
  std::vector<Piece> pieces_;        // in the order of the edges
  std::vector<Index> partner_;       // for each piece, the piece that lies on it; -1 if none does
  bool any_contact_ = false;
  Cracks result_;
};

}  // namespace

Index Cracks::t_junctions() const {
  std::size_t count = 0;
  for (const EdgeSplit& split : splits) {
    count += split.vertices.size();
  }
  return static_cast<Index>(count);
}

Cracks find_cracks(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
                   std::optional<double> reach) {
  return holes.empty() ? Cracks{} : CrackSearch(X, topology, holes, reach).result();
}

}  // namespace ibmfair
