#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/documentation.h"
#include "commands/hole_json.h"
#include "commands/mesh_statistics.h"
#include "commands/page/mesh_scene.h"
#include "commands/report/reading.h"
#include "commands/report/report_formats.h"
#include "commands/shared_options.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/measure/matching_meshes.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::commands {
namespace {

struct ViewArguments {
  std::string input, page, with;
  InputOptions reading;
  std::string laplacian = "crouzeix-raviart";
  ReportOptions report;
  bool overwrite = false;
};

/// A mesh to be shown.
struct ViewedMesh {
  MeshFile file;
  Topology topology;

  const Points& X() const { return file.mesh().X; }
};

ViewedMesh read_viewed(const std::string& path, const ViewArguments& arguments, const Host& host) {
  ViewedMesh mesh{read_input(path, arguments.reading, host), {}};
  mesh.topology = build_topology(mesh.X(), triangulate(mesh.file.mesh()).F);
  return mesh;
}

/// Reads the second mesh, and gives it the triangles of the first mesh, because the triangulation
/// of a quadrilateral depends on the positions of its corners.
ViewedMesh read_other(const ViewArguments& arguments, const ViewedMesh& first, const Host& host) {
  ViewedMesh other{read_input(arguments.with, arguments.reading, host), {}};
  if (!same_connectivity(first.file.mesh(), other.file.mesh())) {
    throw BadMesh(fmt::format(
        "'{}' and '{}' have different vertices or faces; `ibmfair compare` measures such meshes",
        arguments.input, arguments.with));
  }
  other.topology = build_topology(other.X(), first.topology.F);
  return other;
}

nlohmann::ordered_json state_json(const ViewArguments& arguments, const ViewedMesh& mesh) {
  FlowOptions options;
  options.laplacian = arguments.laplacian;
  return mesh_state_json(mesh.X(), mesh.topology, options);
}

void add_view(const ViewArguments& arguments, const ViewedMesh& mesh, Report& report) {
  report.figures["input"] = arguments.input;
  report.figures["mesh"] = {{"vertices", mesh.topology.vertex_count},
                            {"faces", mesh.file.mesh().faces.size()},
                            {"triangles", mesh.topology.F.rows()},
                            {"mean_edge_length", mean_edge_length(mesh.X(), mesh.topology.E)}};
  report.figures["before"] = state_json(arguments, mesh);
  report.figures["holes"] = nlohmann::ordered_json::array();
  for (const Hole& hole : find_holes(mesh.X(), mesh.topology)) {
    report.figures["holes"].push_back(hole_json(hole));
  }
  report.figures["defects"] = defects_json(mesh.topology);
  report.warnings = defect_list(mesh.X(), mesh.topology);
  add_reading(mesh.file, report);
}

void require_html(const std::string& path) {
  if (!is_page(path)) {
    throw BadOption(
        fmt::format("view: OUT '{}' must end in .html, because it is the name of a page", path));
  }
}

ExitCode run_view(const ViewArguments& arguments, const CLI::App& app, const Host& host) {
  const Console& console = host.console();
  if (arguments.input == "-" && arguments.with == "-") {
    throw BadOption("view: standard input holds one mesh only; name a file for IN or --with");
  }
  require_html(arguments.page);
  ReportOptions reports = arguments.report;
  reports.paths.insert(reports.paths.begin(), arguments.page);
  check_reports(reports, {}, arguments.overwrite);

  const ViewedMesh mesh = read_viewed(arguments.input, arguments, host);
  Report report(app);
  add_view(arguments, mesh, report);
  SceneSource source{arguments.input, {{"mesh", &mesh.X(), &mesh.topology}}, arguments.laplacian};
  source.polygons = &mesh.file.mesh().faces;
  ViewedMesh other;
  if (!arguments.with.empty()) {
    other = read_other(arguments, mesh, host);
    report.figures["other"] = arguments.with;
    report.figures["after"] = state_json(arguments, other);
    source.states = {{"before", &mesh.X(), &mesh.topology}, {"after", &other.X(), &other.topology}};
  }
  report.scene = [&] { return mesh_scene(source, report.warnings, console); };
  host.deliver(reports, arguments.overwrite, report);
  console.detail(fmt::format("{} -> {}", arguments.input, arguments.page));
  return ExitCode::done;
}

}  // namespace

Runner declare_view(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  add_input_argument(app, arguments->input);
  CLI::Option* page =
      app.add_option("OUT", arguments->page, "page to write; its name must end in .html")
          ->type_name(file_to_write)
          ->required();
  note_of(app, *page).extensions = {"html"};
  begin_group(app, "What is shown");
  CLI::Option* with = app.add_option("--with", arguments->with,
                                     "show IN as the mesh before, and this mesh, which must have "
                                     "the same faces, as the mesh after")
                          ->type_name(file_to_read);
  offer_meshes_to_read(app, *with);
  add_laplacian_option(app, arguments->laplacian,
                       "discrete Laplacian of the bending energy (see the list below)");
  add_input_options(app, arguments->reading);
  add_report_options(app, arguments->report);
  add_overwrite_option(app, arguments->overwrite);
  documentation_of(app).examples = {
      {"ibmfair view scan.ply scan.html",
       "makes a page that shows the mesh: its curvature, quality, holes and defects"},
      {"ibmfair view scan.ply both.html --with fair.ply",
       "shows two meshes with the same faces as before and after"},
  };
  return [arguments, &app](Host& host) { return run_view(*arguments, app, host); };
}

}  // namespace ibmfair::commands
