#include "ibmfair/fill/holes.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/fill/cracks.h"
#include "ibmfair/fill/fins.h"
#include "ibmfair/fill/slits.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {
namespace {

/// Whether two different vertices of the loop have the same coordinates.
bool meets_a_place_twice(const Points& X, std::vector<Index> loop) {
  const auto before = [&](Index a, Index b) {
    return std::lexicographical_compare(X.row(a).begin(), X.row(a).end(), X.row(b).begin(),
                                        X.row(b).end());
  };
  std::sort(loop.begin(), loop.end(), before);
  return std::adjacent_find(loop.begin(), loop.end(), [&](Index a, Index b) {
           return a != b && X.row(a) == X.row(b);
         }) != loop.end();
}

Hole measured(const Points& X, const Topology& topology, Index id) {
  const BoundaryLoop& loop = topology.boundary_loops[static_cast<std::size_t>(id)];
  Hole hole;
  hole.id = id;
  hole.loop = loop.vertices;
  hole.closed = loop.closed;
  hole.simple = loop.simple;
  hole.touches_itself = meets_a_place_twice(X, loop.vertices);
  hole.component = topology.component[loop.vertices.front()];
  for (Index i = 0; i < hole.edges(); ++i) {
    const Index next = (i + 1) % static_cast<Index>(hole.loop.size());
    hole.perimeter += (X.row(hole.loop[i]) - X.row(hole.loop[next])).norm();
  }
  hole.diameter = bounding_box_size(X(hole.loop, Eigen::all)).norm();
  return hole;
}

/// The largest area of a projection of the loop onto a plane: the length of its vector area.
double spanned_area(const Points& X, const std::vector<Index>& loop) {
  Vec3 sum = Vec3::Zero();
  const Vec3 origin = X.row(loop.front());
  for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
    sum += (X.row(loop[i]).transpose() - origin).cross(X.row(loop[i + 1]).transpose() - origin) / 2;
  }
  return sum.norm();
}

void find_outer_borders(const Points& X, const Topology& topology, std::vector<Hole>& holes) {
  if (holes.empty()) {
    return;
  }
  std::vector<double> area(static_cast<std::size_t>(topology.component_count), 0);
  const Eigen::VectorXd areas = triangle_areas(X, topology.F);
  for (Index t = 0; t < topology.F.rows(); ++t) {
    // Vertices of triangles with a repeated corner may belong to no component.
    if (const Index component = topology.component[topology.F(t, 0)]; component >= 0) {
      area[component] += areas[t];
    }
  }
  std::vector<Hole*> longest(area.size(), nullptr);
  for (Hole& hole : holes) {
    Hole*& other = longest[hole.component];
    if (other == nullptr || hole.perimeter > other->perimeter) {
      other = &hole;
    }
  }
  for (Hole* hole : longest) {
    if (hole != nullptr && area[hole->component] > 0) {
      hole->border_share = spanned_area(X, hole->loop) / area[hole->component];
      hole->outer_border = hole->border_share > border_share_limit;
    }
  }
}

void find_cracks_and_slits(const Points& X, const Topology& topology, std::vector<Hole>& holes) {
  const Cracks cracks = find_cracks(X, topology, holes);
  const SlitSearch slits(X, topology, holes);
  for (Hole& hole : holes) {
    hole.crack = cracks.loops[hole.id];
    if (hole.crack.kind != LoopKind::hole) {
      continue;
    }
    if (const std::optional<double> width = slits.width_at(hole)) {
      hole.crack.kind = LoopKind::slit;
      hole.crack.width = *width;
    }
  }
}

}  // namespace

std::string_view name_of(LoopKind kind) {
  constexpr std::array<std::string_view, 4> names{"hole", "crack", "partial crack", "slit"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<Hole> find_holes(const Points& X, const Topology& topology) {
  if (const std::vector<Index> fins = find_fins(topology); !fins.empty()) {
    return find_holes(X, without_triangles(topology, fins));
  }
  const auto count = static_cast<Index>(topology.boundary_loops.size());
  std::vector<Hole> holes;
  holes.reserve(count);
  for (Index id = 0; id < count; ++id) {
    holes.push_back(measured(X, topology, id));
  }
  find_outer_borders(X, topology, holes);
  find_cracks_and_slits(X, topology, holes);
  return holes;
}

std::string reason_to_skip(const Hole& hole, const HoleChoice& choice) {
  const bool named =
      std::find(choice.only.begin(), choice.only.end(), hole.id) != choice.only.end();
  if (!choice.only.empty() && !named) {
    return "not among those asked for";
  }
  if (hole.outer_border && !choice.all && !named) {
    return fmt::format("an outer border: its loop spans {:.0f} % of its component's area",
                       100 * hole.border_share);
  }
  if (choice.most_edges > 0 && hole.edges() > choice.most_edges) {
    return fmt::format("it has {} edges, more than {}", hole.edges(), choice.most_edges);
  }
  if (choice.longest_perimeter > 0 && hole.perimeter > choice.longest_perimeter) {
    return fmt::format("its perimeter {:.6g} is above {:.6g}", hole.perimeter,
                       choice.longest_perimeter);
  }
  if (choice.largest_diameter > 0 && hole.diameter > choice.largest_diameter) {
    return fmt::format("its diameter {:.6g} is above {:.6g}", hole.diameter,
                       choice.largest_diameter);
  }
  return {};
}

std::string describe_crack(const Hole& hole) {
  const LoopCrack& crack = hole.crack;
  const auto& [vertex, a, b] = crack.t_junction;
  std::string junctions;
  if (crack.t_junctions > 1) {
    junctions = fmt::format(
        "{} vertices lie on its edges, as vertex {} on {}-{}, without splitting them (`fill "
        "--stitch` splits them)",
        crack.t_junctions, vertex, a, b);
  } else if (vertex >= 0) {
    junctions = fmt::format(
        "vertex {} lies on the edge {}-{} without splitting it (`fill --stitch` splits it)", vertex,
        a, b);
  } else {
    junctions = crack.exact
                    ? "its edges lie on other boundary edges (--weld merges their vertices)"
                    : "its edges nearly lie on other boundary edges (`fill --stitch` merges their "
                      "vertices)";
  }
  switch (crack.kind) {
    case LoopKind::hole:
      return {};
    case LoopKind::crack:
      return "a crack, not a hole: " + junctions;
    case LoopKind::partial_crack:
      return fmt::format("a crack along {} of its {} edges: {}", crack.edges, hole.edges(),
                         junctions);
    case LoopKind::slit:
      return fmt::format("a slit, at most {:.2g} wide: {:.2g} of its mean edge length", crack.width,
                         crack.width * hole.edges() / hole.perimeter);
  }
  return {};
}

void require_known_holes(const std::vector<Hole>& holes, const HoleChoice& choice) {
  std::vector<Index> ids = choice.only;
  for (const auto& bridge : choice.bridges) {
    ids.insert(ids.end(), bridge.begin(), bridge.end());
  }
  for (const Index id : ids) {
    if (id < 0 || id >= static_cast<Index>(holes.size())) {
      throw BadOption(
          holes.empty()
              ? fmt::format("there is no hole {}: the mesh has no boundary loops", id)
              : fmt::format(
                    "there is no hole {}: the mesh has holes 0 to {} (`ibmfair holes` lists them)",
                    id, holes.size() - 1));
    }
  }
}

std::vector<std::vector<Index>> simple_loops(const std::vector<Index>& loop) {
  std::vector<std::vector<Index>> loops;
  std::vector<Index> open;
  std::unordered_map<Index, std::size_t> place;  // of the vertices in `open`
  for (const Index v : loop) {
    if (const auto met = place.find(v); met != place.end()) {
      const std::size_t first = met->second;
      loops.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(first), open.end());
      while (open.size() > first) {
        place.erase(open.back());
        open.pop_back();
      }
    }
    place[v] = open.size();
    open.push_back(v);
  }
  loops.push_back(std::move(open));
  return loops;
}

}  // namespace ibmfair
