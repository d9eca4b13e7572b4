#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/crack_summary.h"
#include "commands/defect_warnings.h"
#include "commands/documentation.h"
#include "commands/report/reading.h"
#include "commands/report/report_formats.h"
#include "commands/shared_options.h"
#include "commands/value_list.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/measure/mesh_summary.h"
#include "ibmfair/measure/sphere_fit.h"
#include "ibmfair/measure/used_vertices.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/solve/spectrum.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

struct InfoArguments {
  std::string path;
  InputOptions input;
  ReportOptions report;
  bool overwrite = false;
  bool strict = false;
  bool sphere = false;
  std::string laplacian, mass;
};

struct Energy {
  std::string model;
  double value;
};

/// The members of the family whose energies are always reported.
constexpr std::array<std::string_view, 2> usual_models{"crouzeix-raviart", "lagrange"};

/// The data about the Laplacian that --laplacian selects.
struct Operator {
  std::string laplacian;
  const MassMatrix* mass;
  double energy;
  SpectrumEnds spectrum;
};

/// All results of the command.
struct Findings {
  MeshSummary summary;
  std::vector<Energy> energies;
  std::optional<SphereFit> sphere;
  std::optional<Operator> chosen;
  std::int64_t coincident = 0;      ///< vertices that lie exactly on others
  std::optional<OpenParts> welded;  ///< what would be open with --weld; only if vertices coincide
};

Operator examine_operator(const Mesh& mesh, const Topology& topology,
                          const InfoArguments& arguments) {
  const BendingModel& model = bending_model(arguments.laplacian);
  const EnergyOptions options{true, {}, arguments.mass};
  return {arguments.laplacian, &mass_matrix(model, options),
          model.create(topology, options)->energy(mesh.X),
          spectrum_ends(model.matrices(mesh.X, topology, options))};
}

Findings examine(const Mesh& mesh, const Topology& topology, const InfoArguments& arguments) {
  Findings findings;
  findings.summary = summarise(mesh, topology);
  for (const std::string_view model : usual_models) {
    findings.energies.push_back({std::string(model), bending_energy(mesh.X, topology, model)});
  }
  if (!arguments.laplacian.empty()) {
    findings.chosen = examine_operator(mesh, topology, arguments);
  }
  if (arguments.sphere) {
    findings.sphere = fit_sphere(used_positions(mesh.X, topology.F));
  }
  const Weld weld = find_coincident_vertices(mesh.X);
  findings.coincident = std::ssize(weld.vertex) - std::ssize(weld.first);
  if (findings.coincident > 0) {
    findings.welded = open_parts_after(weld, mesh);
  }
  return findings;
}

ordered_json vector_json(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

template <class T>
ordered_json optional_json(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

void add_findings(ordered_json& json, const MeshFile& file, const Topology& topology,
                  const Findings& findings) {
  const MeshSummary& s = findings.summary;
  json["file"] = file.name();
  json["format"] = file.format().name;
  json["vertices"] = s.vertices;
  json["isolated_vertices"] = s.isolated_vertices;
  json["faces"] = s.faces;
  json["triangles"] = s.triangles;
  json["edges"] = s.edges;
  json["hinges"] = s.hinges;
  json["components"] = s.components;
  json["closed"] = s.closed;
  json["orientable"] = s.orientable;
  json["turned_triangles"] = s.turned_triangles;
  json["euler_characteristic"] = s.euler_characteristic;
  json["genus"] = optional_json(s.genus);
  json["boundary_loops"] = s.boundary_loops;
  json["longest_boundary_loop"] = s.longest_loop;
  json["coincident_vertices"] = findings.coincident;
  json["after_weld"] = findings.welded ? open_json(*findings.welded) : ordered_json();
  json["defects"] = defects_json(topology);
  json["edge_length"] = {{"min", s.shortest_edge}, {"mean", s.mean_edge}, {"max", s.longest_edge}};
  json["smallest_angle_degrees"] = s.smallest_angle;
  json["area"] = s.area;
  json["volume"] = optional_json(s.volume);
  json["bounding_box"] = {{"min", vector_json(s.smallest_corner)},
                          {"max", vector_json(s.largest_corner)}};
  json["bending_energy"] = ordered_json::object();
  for (const Energy& energy : findings.energies) {
    json["bending_energy"][energy.model] = energy.value;
  }
  if (findings.chosen) {
    const SpectrumEnds& spectrum = findings.chosen->spectrum;
    json["operator"] = {{"laplacian", findings.chosen->laplacian},
                        {"mass", findings.chosen->mass->name},
                        {"bending_energy", findings.chosen->energy},
                        {"nodes", spectrum.nodes},
                        {"zero_eigenvalues", spectrum.zeros},
                        {"smallest_eigenvalue", optional_json(spectrum.smallest)},
                        {"largest_eigenvalue", optional_json(spectrum.largest)}};
  }
  if (findings.sphere) {
    json["sphere"] = {{"center", vector_json(findings.sphere->center)},
                      {"radius", findings.sphere->radius},
                      {"relative_deviation", findings.sphere->deviation}};
  }
}

std::string orientation_text(const MeshSummary& s) {
  if (!s.orientable) {
    return "none: not orientable";
  }
  return s.turned_triangles == 0
             ? "coherent"
             : counted(s.turned_triangles, "triangle", "triangles") + " against the majority";
}

std::string vector_text(const Vec3& x) {
  return fmt::format("{} {} {}", eight_digits(x[0]), eight_digits(x[1]), eight_digits(x[2]));
}

std::string eigenvalue_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.8g}", *value) : "none found";
}

std::string spectrum_text(const Operator& chosen) {
  const SpectrumEnds& s = chosen.spectrum;
  return fmt::format("{} zero, then {} to {}{}", s.zeros, eigenvalue_text(s.smallest),
                     eigenvalue_text(s.largest), chosen.mass->measures_area() ? " 1/u^2" : "");
}

std::string coincident_text(const Findings& findings) {
  if (!findings.welded) {
    return "none";
  }
  const OpenParts& parts = *findings.welded;
  return fmt::format(
      "{}; with --weld {}, {}", findings.coincident,
      counted(parts.components, "component", "components"),
      parts.closed ? "closed" : counted(parts.boundary_loops, "boundary loop", "boundary loops"));
}

std::string to_text(const MeshFile& file, const Topology& topology, const Findings& findings) {
  const MeshSummary& s = findings.summary;
  ValueList list;
  list.add("file", fmt::format("{} ({})", file.name(), file.format().title));
  list.add("vertices", fmt::format("{}{}", s.vertices,
                                   s.isolated_vertices == 0 ? ""
                                                            : fmt::format(", {} of them isolated",
                                                                          s.isolated_vertices)));
  list.add("faces", s.faces == s.triangles
                        ? fmt::format("{}", s.faces)
                        : fmt::format("{}, cut into {} triangles", s.faces, s.triangles));
  list.add("edges", fmt::format("{}, {}", s.edges, counted(s.hinges, "hinge", "hinges")));
  list.add("components", fmt::format("{}{}", s.components, s.closed ? ", closed" : ""));
  list.add("genus", s.genus        ? fmt::format("{}", *s.genus)
                    : s.orientable ? "none: the mesh has defects"
                                   : "none: not orientable");
  list.add("orientation", orientation_text(s));
  list.add("boundary loops", s.boundary_loops == 0
                                 ? "0"
                                 : fmt::format("{}, longest of {}", s.boundary_loops,
                                               counted(s.longest_loop, "edge", "edges")));
  list.add("coincident", coincident_text(findings));
  const std::vector<std::string> defects = defect_lines(topology);
  list.add("defects", defects.empty() ? "none" : defects.front());
  for (std::size_t i = 1; i < defects.size(); ++i) {
    list.add("", defects[i]);
  }
  list.add("edge length", fmt::format("{} to {}, mean {}", eight_digits(s.shortest_edge),
                                      eight_digits(s.longest_edge), eight_digits(s.mean_edge)));
  list.add("smallest angle", eight_digits(s.smallest_angle) + " degrees");
  list.add("area", s.area);
  list.add("volume", s.volume   ? eight_digits(*s.volume)
                     : s.closed ? "none: not orientable"
                                : "none: not closed");
  list.add("bounding box",
           vector_text(s.smallest_corner) + "  to  " + vector_text(s.largest_corner));
  for (const Energy& energy : findings.energies) {
    list.add("E_b " + energy.model, energy.value);
  }
  if (findings.chosen) {
    list.add("Laplacian",
             fmt::format("{}, mass {}", findings.chosen->laplacian, findings.chosen->mass->name));
    list.add("its energy E_b", findings.chosen->energy);
    list.add("its eigenvalues", spectrum_text(*findings.chosen));
  }
  if (findings.sphere) {
    list.add("sphere", fmt::format("radius {} about {}", eight_digits(findings.sphere->radius),
                                   vector_text(findings.sphere->center)));
    list.add("radius deviation", fmt::format("{:.4e} of the radius", findings.sphere->deviation));
  }
  return list.text();
}

ExitCode run_info(const InfoArguments& arguments, const CLI::App& app, const Host& host) {
  check_reports(arguments.report, {}, arguments.overwrite);
  const MeshFile file = read_input(arguments.path, arguments.input, host);
  const Mesh& mesh = file.mesh();
  const Topology topology = build_topology(mesh.X, triangulate(mesh).F);
  const Findings findings = examine(mesh, topology, arguments);

  Report report(app);
  add_findings(report.figures, file, topology, findings);
  report.warnings = defect_list(mesh.X, topology);
  add_reading(file, report);
  host.deliver(arguments.report, arguments.overwrite, report);
  if (!arguments.report.json) {
    write_standard_output(to_text(file, topology, findings));
  }
  if (arguments.strict) {
    require_no_defects(topology);
  }
  return ExitCode::done;
}

}  // namespace

Runner declare_info(CLI::App& app) {
  auto arguments = std::make_shared<InfoArguments>();
  add_input_argument(app, arguments->path);
  begin_group(app, "What to measure");
  app.add_flag("--sphere", arguments->sphere,
               "fit a sphere, and print the standard deviation of the vertices' distances to its "
               "centre, divided by their mean");
  CLI::Option* laplacian =
      add_laplacian_option(app, arguments->laplacian,
                           "print the energy of this Laplacian L, and of M^-1 L the number of zero "
                           "eigenvalues, the smallest other eigenvalue and the largest eigenvalue "
                           "(in 1 / mesh units^2 if the mass measures area)");
  note_of(app, *laplacian).default_text = "none";
  add_mass_option(app, arguments->mass)->needs(laplacian);
  add_input_options(app, arguments->input);
  add_strict_option(app, arguments->strict);
  add_report_options(app, arguments->report);
  add_overwrite_option(app, arguments->overwrite);
  documentation_of(app).examples = {
      {"ibmfair info scan.ply", "prints counts, defects, sizes and bending energies"},
      {"ibmfair make icosphere - --format off --subdivide 4 | ibmfair info - --sphere",
       "reads a mesh from a pipe, and prints how far it is from a sphere"},
      {"ibmfair info scan.ply --laplacian lagrange --mass voronoi",
       "also prints the smallest and largest eigenvalue of that Laplacian"},
  };
  return [arguments, &app](Host& host) { return run_info(*arguments, app, host); };
}

}  // namespace ibmfair::commands
