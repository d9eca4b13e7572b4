#include "commands/crack_summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/value_list.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

/// The length as --weld and --stitch take it.
std::string length_text(double length) {
  return fmt::format("{:.0e}", length);
}

/// The next larger number with one digit, 4e-7 for 3.2e-7, exactly as length_text() gives it.
double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  return real_or_zero(length_text(std::ceil(x / unit * (1 + 1e-12)) * unit));
}

/// What is left of so many boundary loops with this option.
std::string result_of(const std::string& option, const OpenParts& left, Index loops) {
  const std::string joined =
      left.non_manifold_edges == 0
          ? ""
          : fmt::format("; {} of three or more triangles",
                        counted(left.non_manifold_edges, "edge is", "edges are"));
  if (left.boundary_loops == 0) {
    return fmt::format("with {} no hole is left{}", option, joined);
  }
  return fmt::format("with {} {} of {} are left{}{}", option, left.boundary_loops,
                     counted(loops, "boundary loop", "boundary loops"),
                     left.holes == 0 ? ", which are outer borders" : "", joined);
}

/// What --weld and --stitch would do.
void compute_remedies(const Mesh& mesh, const Topology& topology, const std::vector<Hole>& holes,
                      CrackSummary& summary) {
  const Weld weld = find_coincident_vertices(mesh.X);
  summary.coincident = std::ssize(weld.vertex) - std::ssize(weld.first);
  if (summary.coincident > 0) {
    summary.welded = open_parts_after(weld, mesh);
  }
  const Cracks cracks = find_cracks(mesh.X, topology, holes);
  if (cracks.empty() || (summary.welded && summary.welded->boundary_loops == 0)) {
    return;
  }
  summary.stitched = open_parts(stitched(mesh, cracks));
  if (cracks.splits.empty() && cracks.farthest > 0) {
    summary.tolerance = rounded_up(cracks.farthest);
    summary.welded_within = open_parts_after(find_close_vertices(mesh.X, summary.tolerance), mesh);
  }
}

}  // namespace

CrackSummary summarise_cracks(const Mesh& mesh, const Topology& topology,
                              const std::vector<Hole>& holes) {
  CrackSummary summary;
  summary.loops = static_cast<Index>(holes.size());
  bool any = false;
  double widest = 0;
  for (const Hole& hole : holes) {
    widest = std::max(widest, hole.crack.width);
    summary.cracks += hole.crack.kind == LoopKind::crack ? 1 : 0;
    summary.partial_cracks += hole.crack.kind == LoopKind::partial_crack ? 1 : 0;
    summary.slits += hole.crack.kind == LoopKind::slit ? 1 : 0;
    summary.t_junctions += hole.crack.t_junctions;
    any = any || hole.touches_itself;
  }
  if (any || summary.cracks + summary.partial_cracks > 0) {
    compute_remedies(mesh, topology, holes, summary);
  }
  if (widest > 0) {
    summary.reach = rounded_up(widest);
    summary.stitched_within =
        open_parts(stitched(mesh, find_cracks(mesh.X, topology, holes, summary.reach)));
  }
  return summary;
}

std::vector<std::string> crack_notes(const CrackSummary& s) {
  std::vector<std::string> notes;
  Index left = s.loops;
  if (s.welded) {
    notes.push_back(fmt::format("{} with others: {}",
                                counted(s.coincident, "vertex coincides", "vertices coincide"),
                                s.welded->boundary_loops < s.loops
                                    ? result_of("--weld", *s.welded, s.loops)
                                    : "--weld merges them, and usually holes are filled better "
                                      "then"));
    left = std::min(left, s.welded->boundary_loops);
  }
  if (s.welded_within && s.welded_within->boundary_loops < left) {
    const std::string option = fmt::format("--weld {}u", length_text(s.tolerance));
    notes.push_back("vertices nearly coincide: " + result_of(option, *s.welded_within, s.loops));
  } else if (s.stitched && s.stitched->boundary_loops < left) {
    notes.push_back(s.t_junctions > 0
                        ? fmt::format("{}, where a vertex lies on an edge without splitting it: {}",
                                      counted(s.t_junctions, "T-junction", "T-junctions"),
                                      result_of("`fill --stitch`", *s.stitched, s.loops))
                        : "vertices nearly coincide: " +
                              result_of("`fill --stitch`", *s.stitched, s.loops));
    left = s.stitched->boundary_loops;
  }
  if (s.stitched_within && s.stitched_within->boundary_loops < left &&
      s.stitched_within->non_manifold_edges == 0) {
    const std::string option = fmt::format("`fill --stitch {}u`", length_text(s.reach));
    notes.push_back(fmt::format("{}, whose sides run along each other: {}",
                                counted(s.slits, "slit", "slits"),
                                result_of(option, *s.stitched_within, s.loops)));
  }
  return notes;
}

ordered_json open_json(const OpenParts& parts) {
  return {{"components", parts.components},
          {"boundary_loops", parts.boundary_loops},
          {"holes", parts.holes},
          {"non_manifold_edges", parts.non_manifold_edges},
          {"closed", parts.closed}};
}

ordered_json crack_json(const CrackSummary& summary) {
  ordered_json json = {{"cracks", summary.cracks},
                       {"partial_cracks", summary.partial_cracks},
                       {"slits", summary.slits},
                       {"t_junctions", summary.t_junctions},
                       {"coincident_vertices", summary.coincident}};
  if (summary.welded) {
    json["after_weld"] = open_json(*summary.welded);
  }
  if (summary.welded_within) {
    json["weld_tolerance"] = summary.tolerance;
    json["after_weld_within_tolerance"] = open_json(*summary.welded_within);
  }
  if (summary.stitched) {
    json["after_stitch"] = open_json(*summary.stitched);
  }
  if (summary.stitched_within) {
    json["stitch_reach"] = summary.reach;
    json["after_stitch_within_reach"] = open_json(*summary.stitched_within);
  }
  return json;
}

}  // namespace ibmfair::commands
