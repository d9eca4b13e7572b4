#include "commands/defect_warnings.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/errors.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

struct Kind {
  const char* what;   // for a person
  const char* field;  // of the report
  const std::vector<Index> Defects::*list;
};

constexpr std::array<Kind, 5> kinds{{
    {"triangles with a repeated corner", "repeated_corner_triangles", &Defects::repeated_corner},
    {"triangles without area", "zero_area_triangles", &Defects::zero_area},
    {"triangles over the same vertices as another", "duplicate_triangles", &Defects::duplicate},
    {"edges of three or more triangles", "non_manifold_edges", &Defects::non_manifold_edges},
    {"bow-tie vertices", "bow_tie_vertices", &Defects::bow_tie_vertices},
}};

/// An edge is named by its two vertices, everything else by its number.
std::string name(const Topology& topology, const Kind& kind, Index i) {
  return kind.list == &Defects::non_manifold_edges
             ? fmt::format("{}-{}", topology.E(i, 0), topology.E(i, 1))
             : fmt::format("{}", i);
}

std::string describe(const Topology& topology, const Kind& kind) {
  constexpr std::size_t most = 5;
  const auto& list = topology.defects.*kind.list;
  std::string text = fmt::format("{} {} (", list.size(), kind.what);
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i) {
    text += (i > 0 ? ", " : "") + name(topology, kind, list[i]);
  }
  return text + (list.size() > most ? ", ...)" : ")");
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
    throw BadMesh(fmt::format("the mesh has defects: {}", fmt::join(lines, "; ")));
  }
}

void warn_of_defects(const Topology& topology, bool strict, const Console& console) {
  if (strict) {
    require_no_defects(topology);
  }
  for (const std::string& line : defect_lines(topology)) {
    console.warning(line + ": left out of the energy, their vertices are held");
  }
}

ordered_json defects_json(const Topology& topology) {
  // Not null: the library crashes where it makes an object of that and there is no memory.
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
