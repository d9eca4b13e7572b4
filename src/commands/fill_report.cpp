#include "commands/fill_report.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/hole_json.h"
#include "commands/stage_times.h"
#include "commands/value_list.h"
#include "ibmfair/base/angle.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

constexpr int first_few = 20;

ordered_json bends_json(const Bends& bends) {
  return {{"median", degrees(bends.median)}, {"largest", degrees(bends.largest)}};
}

ordered_json fairing_json(const FairingReport& fairing) {
  return {{"converged", fairing.converged},
          {"energy_before", fairing.energy_before},
          {"energy_after", fairing.energy_after},
          {"normal_gradient_ratio", fairing.gradient_ratio},
          {"last_normal_move", fairing.last_move},
          {"levels", fairing.levels},
          {"steps", fairing.steps},
          {"solves", fairing.flow.solves},
          {"factorizations", fairing.flow.factorizations}};
}

ordered_json seconds_json(const FillSeconds& seconds) {
  return {{"read", seconds.read},
          {"topology", seconds.topology},
          {"fill", seconds.fill},
          {"audit", seconds.audit},
          {"write", seconds.write}};
}

ordered_json seam_json(const SeamAudit& seam) {
  return {{"seam_degrees", bends_json(seam.seam)},
          {"surroundings_degrees", bends_json(seam.surroundings)},
          {"folded_hinges", seam.folds}};
}

ordered_json rejected_json(const std::vector<RejectedPatch>& rejected) {
  ordered_json json = ordered_json::array();
  for (const RejectedPatch& patch : rejected) {
    json.push_back({{"method", patch.method}, {"reason", patch.reason}});
  }
  return json;
}

ordered_json creases_json(const CreaseReport& creases) {
  return {{"ends", creases.ends},           {"left_out", creases.left_out},
          {"rim_edges", creases.rim_edges}, {"curves", creases.curves},
          {"corners", creases.corners},     {"reason", creases.reason}};
}

ordered_json surroundings_json(const RimSurroundings& surroundings) {
  ordered_json json{{"kind", name_of(surroundings.kind)}, {"roughness", surroundings.roughness}};
  if (surroundings.likeness) {
    json["likeness"] = *surroundings.likeness;
  }
  return json;
}

ordered_json filled_hole_json(const Hole& rim, const HoleReport& hole) {
  ordered_json json = hole_json(rim);
  json["status"] = name_of(hole.status);
  json["reason"] = hole.reason;
  if (hole.bridged_to >= 0) {
    json["bridged_to"] = hole.bridged_to;
  }
  json["new_vertices"] = hole.new_vertices;
  json["new_triangles"] = hole.new_triangles;
  if (!hole.protruding.empty()) {
    json["protruding"] = hole.protruding;
  }
  if (!hole.rejected.empty()) {
    json["rejected"] = rejected_json(hole.rejected);
  }
  if (hole.new_triangles > 0) {
    json["method"] = hole.method;
    if (hole.surroundings) {
      json["surroundings"] = surroundings_json(*hole.surroundings);
    }
    if (hole.creases) {
      json["creases"] = creases_json(*hole.creases);
    }
    json["diameter_ratio"] = hole.diameter_ratio;
    json["area_ratio"] = hole.area_ratio;
    json.update(seam_json(hole.seam));
    json["intersections"] = hole.intersections;
    json["fairing"] = fairing_json(hole.fairing);
  }
  return json;
}

/// The bridges, once each, with what they added to the mesh.
ordered_json bridges_json(const std::vector<HoleReport>& holes) {
  ordered_json json = ordered_json::array();
  for (const HoleReport& hole : holes) {
    if (hole.bridged_to > hole.hole) {
      const HoleReport& other = holes[static_cast<std::size_t>(hole.bridged_to)];
      json.push_back({{"holes", {hole.hole, other.hole}},
                      {"status", name_of(hole.status)},
                      {"new_vertices", hole.new_vertices + other.new_vertices},
                      {"new_triangles", hole.new_triangles + other.new_triangles}});
    }
  }
  return json;
}

Warning warning_of(const Points& X, const Hole& rim, const HoleReport& hole) {
  ScenePlace place;
  place.title = fmt::format("hole {}", hole.hole);
  place.at = X(rim.loop, Eigen::all).colwise().mean();
  place.radius = rim.diameter / 2;
  return {fmt::format("hole {}: {}, {}", hole.hole, name_of(hole.status), hole.reason), place};
}

constexpr const char* hole_columns =
    "  {:>6}  {:<14}{:>9}{:>10}{:>9}{:>8}{:>11}{:>10}{:>10}{:>8}{:>8}  {}";

std::string crease_remark(const CreaseReport& creases) {
  if (!creases.reason.empty()) {
    return fmt::format("its creases are not continued: {}", creases.reason);
  }
  std::vector<std::string> parts;
  if (creases.curves > 0) {
    parts.push_back(counted(creases.curves, "crease", "creases"));
  }
  if (creases.corners > 0) {
    parts.push_back(counted(creases.corners, "corner", "corners"));
  }
  if (creases.rim_edges > 0) {
    parts.push_back(counted(creases.rim_edges, "rim edge on a crease", "rim edges on creases"));
  }
  if (creases.left_out > 0) {
    parts.push_back(counted(creases.left_out, "crease not continued", "creases not continued"));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The reason why the hole is not filled, or the flaws of its filling.
std::string remarks(const HoleReport& hole) {
  std::vector<std::string> parts;
  if (!hole.reason.empty()) {
    parts.push_back(hole.reason);
  }
  if (hole.bridged_to >= 0 && hole.new_triangles > 0) {
    parts.push_back(fmt::format("bridged to hole {}", hole.bridged_to));
  }
  if (!hole.rejected.empty() && !hole.method.empty()) {
    const RejectedPatch& first = hole.rejected.front();
    parts.push_back(
        fmt::format("filled by {} (by {}: {})", hole.method, first.method, first.reason));
  }
  if (!hole.protruding.empty()) {
    parts.push_back(fmt::format(
        "{} at its rim left aside, such as {}",
        counted(std::ssize(hole.protruding), "protruding triangle", "protruding triangles"),
        hole.protruding.front()));
  }
  if (hole.creases) {
    parts.push_back(crease_remark(*hole.creases));
  }
  if (hole.seam.folds > 0) {
    parts.push_back(counted(hole.seam.folds, "fold", "folds"));
  }
  if (hole.intersections > 0) {
    parts.push_back(counted(hole.intersections, "intersection", "intersections"));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string hole_line(const HoleReport& hole) {
  const FairingReport& fairing = hole.fairing;
  const bool filled = hole.new_triangles > 0, faired = filled && fairing.steps > 0;
  const auto if_filled = [filled](auto value, const char* format) {
    return filled ? fmt::format(fmt::runtime(format), value) : std::string("-");
  };
  std::string line =
      fmt::format(hole_columns, hole.hole, name_of(hole.status), if_filled(hole.new_vertices, "{}"),
                  if_filled(hole.new_triangles, "{}"), if_filled(hole.diameter_ratio, "{:.3g}"),
                  if_filled(hole.area_ratio, "{:.3g}"),
                  faired ? fmt::format("{:.4g}", fairing.energy_after) : "-",
                  faired ? change_text(fairing.energy_before, fairing.energy_after) : "-",
                  faired ? fmt::format("{:.1e}", fairing.gradient_ratio) : "-",
                  if_filled(degrees(hole.seam.seam.median), "{:.2g}"),
                  if_filled(degrees(hole.seam.surroundings.median), "{:.2g}"), remarks(hole));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// Names and units of the columns; energies and ratios have no unit, angles are in degrees.
std::string hole_heading() {
  std::string text =
      fmt::format(hole_columns, "hole", "status", "vertices", "triangles", "diameter", "area",
                  "energy", "change", "gradient", "seam", "around", "");
  text.erase(text.find_last_not_of(' ') + 1);
  std::string units = fmt::format(hole_columns, "", "", "new", "new", "x hole", "x hole", "", "",
                                  "x start", "deg", "deg", "");
  units.erase(units.find_last_not_of(' ') + 1);
  return text + "\n" + units + "\n";
}

std::string times(const FillSeconds& seconds, bool detailed) {
  return stage_times_line({{"read", seconds.read},
                           {"topology", seconds.topology},
                           {"fill", seconds.fill},
                           {"audit", seconds.audit},
                           {"write", seconds.write}},
                          detailed);
}

/// A line about what the surroundings of the holes are like and how these holes were filled; empty
/// if the surroundings decided on nothing.
std::string choices(const Filling& filling) {
  std::map<std::string, int> holes;  // by surroundings and method
  for (const HoleReport& hole : filling.holes) {
    if (hole.surroundings) {
      ++holes[fmt::format("{} surroundings, by {}", name_of(hole.surroundings->kind), hole.method)];
    }
  }
  std::vector<std::string> parts;
  for (const auto& [choice, count] : holes) {
    parts.push_back(fmt::format("{} with {}", counted(count, "hole", "holes"), choice));
  }
  return parts.empty() ? std::string() : fmt::format("  {}\n", fmt::join(parts, "; "));
}

}  // namespace

std::string fill_text(const Filling& filling, const FillSeconds& seconds, bool detailed) {
  std::string text = hole_heading();
  int shown = 0, left = 0;
  for (const HoleReport& hole : filling.holes) {
    if (!detailed && shown >= first_few) {
      ++left;
    } else {
      text += hole_line(hole);
      ++shown;
    }
  }
  if (left > 0) {
    text += fmt::format("  and {} more (-v lists all)\n", left);
  }
  return text + choices(filling) + times(seconds, detailed);
}

void add_filling(const Filling& filling, const std::vector<Hole>& holes, const FillSeconds& seconds,
                 Report& report) {
  ordered_json& json = report.figures;
  json["new_vertices"] = filling.new_X.rows();
  json["new_triangles"] = filling.new_F.rows();
  json["holes"] = ordered_json::array();
  report.table = Table{flattened(filled_hole_json({}, {})), {}};
  for (const HoleReport& hole : filling.holes) {
    const Hole& rim = holes[static_cast<std::size_t>(hole.hole)];
    json["holes"].push_back(filled_hole_json(rim, hole));
    report.table->rows.push_back(flattened(json["holes"].back()));
    if (hole.status != HoleStatus::filled && hole.status != HoleStatus::skipped) {
      report.warnings.push_back(warning_of(filling.X, rim, hole));
    }
  }
  if (ordered_json bridges = bridges_json(filling.holes); !bridges.empty()) {
    json["bridges"] = std::move(bridges);
  }
  json["seconds"] = seconds_json(seconds);
}

std::string shortfall(const Filling& filling, bool allow_intersections) {
  std::int64_t open = 0, rough = 0, folds = 0, intersections = 0;
  for (const HoleReport& hole : filling.holes) {
    open += hole.status == HoleStatus::failed ? 1 : 0;
    rough += hole.status == HoleStatus::not_converged || hole.status == HoleStatus::coarse ? 1 : 0;
    folds += hole.seam.folds;
    intersections += hole.intersections;
  }
  std::vector<std::string> parts;
  const auto add = [&parts](std::int64_t count, const char* text) {
    if (count > 0) {
      parts.push_back(fmt::format("{} {}", count, text));
    }
  };
  add(open, "left open");
  add(rough, "not converged");
  add(folds, "folded hinges");
  add(allow_intersections ? 0 : intersections, "intersecting pairs of triangles");
  return parts.empty() ? std::string() : fmt::format("holes: {}", fmt::join(parts, ", "));
}

std::string region_text(const RegionReport& region, const FillSeconds& seconds, bool detailed) {
  return fmt::format(
             "  {} free, energy {:.5g} -> {:.5g} ({}), gradient x {:.1e} in {} solves and {} "
             "factorizations\n",
             counted(region.fairing.flow.unknowns, "vertex", "vertices"),
             region.fairing.energy_before, region.fairing.energy_after,
             change_text(region.fairing.energy_before, region.fairing.energy_after),
             region.fairing.gradient_ratio, region.fairing.flow.solves,
             region.fairing.flow.factorizations) +
         times(seconds, detailed);
}

void add_region(const RegionReport& region, const FillSeconds& seconds, Report& report) {
  ordered_json& json = report.figures;
  json["free_vertices"] = region.fairing.flow.unknowns;
  json["fairing"] = fairing_json(region.fairing);
  const FlowSeconds& s = region.fairing.flow.seconds;
  json["fairing"]["seconds"] = {{"assemble", s.assemble},
                                {"analyse", s.analyse},
                                {"factor", s.factor},
                                {"gradient", s.gradient},
                                {"solve", s.solve}};
  json["folded_hinges"] = region.folds;
  json["seconds"] = seconds_json(seconds);
}

}  // namespace ibmfair::commands
