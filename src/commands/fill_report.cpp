#include "commands/fill_report.h"

#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/figure_list.h"
#include "commands/hole_json.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

constexpr int first_few = 20;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

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

std::string hole_line(const HoleReport& hole) {
  std::string text = fmt::format("  hole {}: {}", hole.hole, name_of(hole.status));
  if (!hole.reason.empty()) {
    text += ", " + hole.reason;
  }
  if (hole.new_triangles > 0) {
    text += fmt::format("; {} + {}", counted(hole.new_vertices, "vertex", "vertices"),
                        counted(hole.new_triangles, "triangle", "triangles"));
    if (hole.fairing.steps > 0) {
      text += fmt::format(", E_b {:.4g} -> {:.4g}, gradient x {:.1e} in {} solves",
                          hole.fairing.energy_before, hole.fairing.energy_after,
                          hole.fairing.gradient_ratio, hole.fairing.flow.solves);
    }
    text += fmt::format(", seam {:.2g} deg (around {:.2g})", degrees(hole.seam.seam.median),
                        degrees(hole.seam.surroundings.median));
    if (hole.seam.folds > 0) {
      text += ", " + counted(hole.seam.folds, "fold", "folds");
    }
    if (hole.intersections > 0) {
      text += ", " + counted(hole.intersections, "intersection", "intersections");
    }
  }
  return text + "\n";
}

std::string times(const FillSeconds& seconds) {
  return fmt::format(
      "  seconds: read {:.3f} topology {:.3f} fill {:.3f} audit {:.3f} write {:.3f}\n",
      seconds.read, seconds.topology, seconds.fill, seconds.audit, seconds.write);
}

}  // namespace

std::string fill_text(const Filling& filling, const FillSeconds& seconds, bool detailed) {
  std::string text;
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
    text += fmt::format("  and {} more (-v tells of all)\n", left);
  }
  return text + times(seconds);
}

void add_filling(ordered_json& report, const Filling& filling, const std::vector<Hole>& holes,
                 const FillSeconds& seconds) {
  report["new_vertices"] = filling.new_X.rows();
  report["new_triangles"] = filling.new_F.rows();
  report["holes"] = ordered_json::array();
  for (const HoleReport& hole : filling.holes) {
    ordered_json json = hole_json(holes[static_cast<std::size_t>(hole.hole)]);
    json["status"] = name_of(hole.status);
    json["reason"] = hole.reason;
    json["new_vertices"] = hole.new_vertices;
    json["new_triangles"] = hole.new_triangles;
    if (hole.new_triangles > 0) {
      json.update(seam_json(hole.seam));
      json["intersections"] = hole.intersections;
      json["fairing"] = fairing_json(hole.fairing);
    }
    report["holes"].push_back(std::move(json));
  }
  report["seconds"] = seconds_json(seconds);
}

std::string region_text(const RegionReport& region, const FillSeconds& seconds) {
  return fmt::format(
             "  {} free, E_b {:.6g} -> {:.6g}, gradient x {:.1e} in {} solves and {} "
             "factorizations\n",
             counted(region.fairing.flow.unknowns, "vertex", "vertices"),
             region.fairing.energy_before, region.fairing.energy_after,
             region.fairing.gradient_ratio, region.fairing.flow.solves,
             region.fairing.flow.factorizations) +
         times(seconds);
}

void add_region(ordered_json& report, const RegionReport& region, const FillSeconds& seconds) {
  report["free_vertices"] = region.fairing.flow.unknowns;
  report["fairing"] = fairing_json(region.fairing);
  const FlowSeconds& s = region.fairing.flow.seconds;
  report["fairing"]["seconds"] = {{"assemble", s.assemble},
                                  {"analyse", s.analyse},
                                  {"factor", s.factor},
                                  {"gradient", s.gradient},
                                  {"solve", s.solve}};
  report["folded_hinges"] = region.folds;
  report["seconds"] = seconds_json(seconds);
}

}  // namespace ibmfair::commands
