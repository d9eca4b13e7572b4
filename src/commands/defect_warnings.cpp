#include "commands/defect_warnings.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/value_list.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

struct Kind {
  const char* element;   // one of them
  const char* elements;  // several
  const char* what;      // what is wrong with them
  const char* one;       // text for a single defect, with the element's name
  const char* field;     // field of the report
  const std::vector<Index> Defects::*list;
};

constexpr std::array<Kind, 5> kinds{{
    {"triangle", "triangles", " with a repeated corner", "triangle {} has a corner twice",
     "repeated_corner_triangles", &Defects::repeated_corner},
    {"triangle", "triangles", " without area", "triangle {} has no area", "zero_area_triangles",
     &Defects::zero_area},
    {"triangle", "triangles", " over the same vertices as another",
     "triangle {} lies over the same vertices as another", "duplicate_triangles",
     &Defects::duplicate},
    {"edge", "edges", " of three or more triangles", "edge {} has three or more triangles",
     "non_manifold_edges", &Defects::non_manifold_edges},
    {"bow-tie vertex", "bow-tie vertices", "", "vertex {} joins several fans of triangles",
     "bow_tie_vertices", &Defects::bow_tie_vertices},
}};

/// The name of an element: for an edge its two vertices, for other elements the number.
std::string name(const Topology& topology, const Kind& kind, Index i) {
  return kind.list == &Defects::non_manifold_edges
             ? fmt::format("{}-{}", topology.E(i, 0), topology.E(i, 1))
             : fmt::format("{}", i);
}

std::string describe(const Topology& topology, const Kind& kind) {
  constexpr std::size_t most = 5;
  const auto& list = topology.defects.*kind.list;
  std::string text =
      fmt::format("{}{} (", counted(std::ssize(list), kind.element, kind.elements), kind.what);
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i) {
    text += (i > 0 ? ", " : "") + name(topology, kind, list[i]);
  }
  return text + (list.size() > most ? ", ...)" : ")");
}

/// What follows from defects of this kind.
const char* consequence(const Kind& kind) {
  return kind.list == &Defects::non_manifold_edges
             ? "left out of the energy, and the vertices there do not move with the sheets that "
               "meet "
               "there"
             : "left out of the energy, and the vertices there stay fixed";
}

/// The vertices of element i.
std::vector<Index> vertices_of(const Topology& topology, const Kind& kind, Index i) {
  if (kind.list == &Defects::bow_tie_vertices) {
    return {i};
  }
  if (kind.list == &Defects::non_manifold_edges) {
    return {topology.E(i, 0), topology.E(i, 1)};
  }
  return {topology.F(i, 0), topology.F(i, 1), topology.F(i, 2)};
}

/// A place that covers the element and the triangles around it.
ScenePlace place_of_element(const Points& X, const Topology& topology, const Kind& kind, Index i) {
  const std::vector<Index> vertices = vertices_of(topology, kind, i);
  ScenePlace place;
  place.title = fmt::format(fmt::runtime(kind.one), name(topology, kind, i));
  place.at = X(vertices, Eigen::all).colwise().mean();
  for (const Index v : vertices) {
    for (const Index t : topology.stars[v]) {
      for (const Index w : topology.F.row(t)) {
        place.radius = std::max(place.radius, (X.row(w).transpose() - place.at).norm());
      }
    }
  }
  return place;
}

}  // namespace

std::vector<std::string> defect_lines(const Topology& topology) {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds) {
    if (!(topology.defects.*kind.list).empty()) {
      lines.push_back(describe(topology, kind));
    }
  }
  return lines;
}

void require_no_defects(const Topology& topology) {
  const std::vector<std::string> lines = defect_lines(topology);
  if (!lines.empty()) {
    throw BadMesh(
        fmt::format("the mesh has defects, which --strict refuses: {}", fmt::join(lines, "; ")));
  }
}

std::vector<Warning> defect_list(const Points& X, const Topology& topology) {
  constexpr std::size_t most = 100;
  std::vector<Warning> warnings;
  for (const Kind& kind : kinds) {
    const auto& list = topology.defects.*kind.list;
    if (!list.empty()) {
      warnings.push_back({fmt::format("{}: {}", describe(topology, kind), consequence(kind))});
    }
    for (std::size_t i = 0; i < std::min(most, list.size()); ++i) {
      const ScenePlace place = place_of_element(X, topology, kind, list[i]);
      warnings.push_back({place.title, place});
    }
  }
  return warnings;
}

void warn_of_defects(const Topology& topology, bool strict, const Console& console) {
  if (strict) {
    require_no_defects(topology);
  }
  for (const Kind& kind : kinds) {
    if (!(topology.defects.*kind.list).empty()) {
      console.warning(fmt::format("{}: {}", describe(topology, kind), consequence(kind)));
    }
  }
}

ordered_json defects_json(const Topology& topology) {
  // An object from the start: the JSON library crashes if it converts null into an object and
  // memory has run out.
  ordered_json json = ordered_json::object();
  for (const Kind& kind : kinds) {
    ordered_json& list = json[kind.field] = ordered_json::array();
    for (const Index i : topology.defects.*kind.list) {
      if (kind.list == &Defects::non_manifold_edges) {
        list.push_back({topology.E(i, 0), topology.E(i, 1)});
      } else {
        list.push_back(i);
      }
    }
  }
  return json;
}

}  // namespace ibmfair::commands
