#include "ibmfair/fill/holes.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/crack_summary.h"
#include "commands/documentation.h"
#include "commands/hole_json.h"
#include "commands/report/reading.h"
#include "commands/report/report_formats.h"
#include "commands/shared_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {
namespace {

struct HolesArguments {
  std::string path;
  InputOptions input;
  ReportOptions report;
  bool overwrite = false;
};

std::string remark(const Hole& hole) {
  std::string text;
  if (!hole.closed) {
    text = "ends at an edge of three or more triangles";
  } else if (!hole.simple) {
    text = "meets a vertex twice";
  } else if (hole.crack.kind != LoopKind::hole) {
    text = describe_crack(hole);
  } else if (hole.touches_itself) {
    text = "passes through a place twice, as different vertices (--weld merges them)";
  }
  if (hole.outer_border) {
    text += fmt::format("{}outer border: spans {:.0f} % of its component's area",
                        text.empty() ? "" : ", ", 100 * hole.border_share);
  }
  return text;
}

std::string to_text(const std::vector<Hole>& holes) {
  std::string text = fmt::format("{:>6}{:>8}{:>14}{:>14}{:>10}  {:<13}  {}\n", "hole", "edges",
                                 "perimeter", "diameter", "vertex", "kind", "remark");
  for (const Hole& hole : holes) {
    std::string line = fmt::format("{:>6}{:>8}{:>14.6g}{:>14.6g}{:>10}  {:<13}  {}", hole.id,
                                   hole.edges(), hole.perimeter, hole.diameter, hole.loop.front(),
                                   name_of(hole.crack.kind), remark(hole));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

ExitCode run_holes(const HolesArguments& arguments, const CLI::App& app, const Host& host) {
  const Console& console = host.console();
  check_reports(arguments.report, {}, arguments.overwrite);
  const MeshFile file = read_input(arguments.path, arguments.input, host);
  const Mesh& mesh = file.mesh();
  const Topology topology = build_topology(mesh.X, triangulate(mesh).F);
  const std::vector<Hole> holes = find_holes(mesh.X, topology);
  const CrackSummary cracks = summarise_cracks(mesh, topology, holes);

  Report report(app);
  report.figures["file"] = file.name();
  report.figures["holes"] = nlohmann::ordered_json::array();
  report.table = Table{hole_json({}), {}};
  for (const Hole& hole : holes) {
    report.table->rows.push_back(hole_json(hole));
    report.figures["holes"].push_back(hole_json(hole));
    report.figures["holes"].back()["vertices"] = hole.loop;
  }
  report.figures["cracks"] = crack_json(cracks);
  add_reading(file, report);
  host.deliver(arguments.report, arguments.overwrite, report);
  for (const std::string& note : crack_notes(cracks)) {
    console.note(note);
  }
  if (!arguments.report.json) {
    if (holes.empty()) {
      console.note("no holes: the mesh is closed");
    } else {
      write_standard_output(to_text(holes));
    }
  }
  return ExitCode::done;
}

}  // namespace

Runner declare_holes(CLI::App& app) {
  auto arguments = std::make_shared<HolesArguments>();
  add_input_argument(app, arguments->path);
  add_input_options(app, arguments->input);
  add_report_options(app, arguments->report);
  add_overwrite_option(app, arguments->overwrite);
  documentation_of(app).examples = {
      {"ibmfair holes scan.ply", "lists the boundary loops: id, edges, perimeter, diameter"},
      {"ibmfair holes scan.ply --json > holes.json",
       "the same as JSON, with the vertices of each loop"},
  };
  return [arguments, &app](Host& host) { return run_holes(*arguments, app, host); };
}

}  // namespace ibmfair::commands
