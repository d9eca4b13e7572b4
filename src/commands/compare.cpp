#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/argument_roles.h"
#include "commands/command.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "commands/report/report_formats.h"
#include "commands/shared_options.h"
#include "commands/value_list.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/measure/directed_distance.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/measure/matching_meshes.h"
#include "ibmfair/measure/mesh_summary.h"
#include "ibmfair/measure/sphere_fit.h"
#include "ibmfair/measure/surface_deviation.h"
#include "ibmfair/measure/used_vertices.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

struct CompareArguments {
  std::string a;
  std::string b;
  std::string sphere;  // "fit" or a radius
  std::optional<std::vector<double>> torus;
  std::vector<double> center{0.0, 0.0, 0.0};
  std::optional<double> tolerance;
  std::int64_t samples = default_samples;
  InputOptions input;
  ReportOptions report;
  bool overwrite = false;
};

/// A mesh with derived data that is used more than once.
struct Side {
  Mesh mesh;
  Triangles F;  // with the orientation of the file
  MeshSummary summary;
};

/// The results of the command, as JSON and as text.
struct Comparison {
  ordered_json& json;
  ValueList list;
  double largest_distance = 0.0;
};

Side read_side(const std::string& path, const InputOptions& options, const Host& host) {
  Side side{read_input(path, options, host).mesh(), {}, {}};
  side.F = triangulate(side.mesh).F;
  side.summary = summarise(side.mesh, build_topology(side.mesh.X, side.F));
  return side;
}

ordered_json statistics_json(const Statistics& s) {
  return {{"mean", s.mean}, {"rms", s.rms}, {"max", s.max}};
}

ordered_json angles_json(const NormalAngles& angles) {
  ordered_json json = statistics_json(angles.degrees);
  json["flipped"] = angles.flipped;
  json["left_out"] = angles.left_out;
  return json;
}

std::string angles_text(const NormalAngles& angles, const std::string& where) {
  std::string text = fmt::format(
      "mean {:.4f} degrees, RMS {:.4f}, largest {:.4f}{}; {} beyond 90 degrees",
      angles.degrees.mean, angles.degrees.rms, angles.degrees.max, where, angles.flipped);
  if (angles.left_out > 0) {
    text += fmt::format(", {} without a normal", angles.left_out);
  }
  return text;
}

std::string lengths_text(const Statistics& s, double unit) {
  return fmt::format("RMS {:.6e}, mean {:.6e}, largest {:.6e}", s.rms / unit, s.mean / unit,
                     s.max / unit);
}

void compare_matching(const Side& a, const Side& b, Comparison& comparison) {
  const Statistics moved = vertex_differences(a.mesh.X, b.mesh.X);
  const NormalAngles angles = face_normal_angles(a.mesh, b.mesh);
  ordered_json& vertices = comparison.json["vertex_distance"] = statistics_json(moved);
  vertices["vertex"] = moved.where;
  vertices["mean_edge"] = a.summary.mean_edge;
  ordered_json& faces = comparison.json["face_normal_degrees"] = angles_json(angles);
  faces["face"] = angles.degrees.where;

  comparison.list.add("vertex to vertex",
                      fmt::format("{}, at vertex {}", lengths_text(moved, 1.0), moved.where));
  if (a.summary.mean_edge > 0.0) {
    comparison.list.add("  in mean edges of A", lengths_text(moved, a.summary.mean_edge));
  }
  comparison.list.add("normals, face to face",
                      angles_text(angles, fmt::format(" at face {}", angles.degrees.where)));
}

void add_direction(const std::string& label, const std::string& field, const DirectedDistance& d,
                   Comparison& comparison) {
  comparison.json["surface_distance"][field] = {
      {"mean", d.mean},
      {"rms", d.rms},
      {"max", d.max},
      {"farthest", {d.farthest[0], d.farthest[1], d.farthest[2]}},
      {"normal_degrees", angles_json(d.angles)}};
  comparison.list.add(label, fmt::format("RMS {:.6e}, mean {:.6e}, largest {:.6e} at {} {} {}",
                                         d.rms, d.mean, d.max, eight_digits(d.farthest[0]),
                                         eight_digits(d.farthest[1]), eight_digits(d.farthest[2])));
  comparison.list.add("  normals", angles_text(d.angles, ""));
  comparison.largest_distance = std::max(comparison.largest_distance, d.max);
}

void add_ratio(const std::string& label, const std::string& field, std::optional<double> a,
               std::optional<double> b, Comparison& comparison) {
  if (a && b && *a != 0.0) {
    comparison.json[field + "_ratio"] = *b / *a;
    comparison.list.add(label, fmt::format("{:.8g} of A's {:.8g}", *b / *a, *a));
  } else {
    comparison.json[field + "_ratio"] = nullptr;
  }
}

void compare_meshes(const Side& a, const Side& b, std::int64_t samples, Comparison& comparison) {
  const bool matching = same_connectivity(a.mesh, b.mesh);
  comparison.json["same_connectivity"] = matching;
  comparison.list.add("connectivity", matching ? "the same" : "different");
  if (matching) {
    compare_matching(a, b, comparison);
  }
  comparison.json["surface_distance"] = ordered_json::object();
  add_direction("surface A to B", "a_to_b",
                directed_distance(a.mesh.X, a.F, b.mesh.X, b.F, samples), comparison);
  add_direction("surface B to A", "b_to_a",
                directed_distance(b.mesh.X, b.F, a.mesh.X, a.F, samples), comparison);
  add_ratio("area of B", "area", a.summary.area, b.summary.area, comparison);
  add_ratio("volume of B", "volume", a.summary.volume, b.summary.volume, comparison);
}

void compare_with_surface(const Side& a, const ExactSurface& surface, const std::string& name,
                          Comparison& comparison) {
  const SurfaceDeviation deviation = deviation_from(surface, a.mesh.X, a.F);
  ordered_json& json = comparison.json["exact_surface"] = ordered_json::object();
  json["surface"] = name;
  json["vertex_distance"] = statistics_json(deviation.distance);
  json["vertex_distance"]["vertex"] = deviation.distance.where;
  json["triangle_normal_degrees"] = angles_json(deviation.angles);
  comparison.list.add("surface", name);
  comparison.list.add("vertex to surface",
                      fmt::format("{}, at vertex {}", lengths_text(deviation.distance, 1.0),
                                  deviation.distance.where));
  comparison.list.add("normals, triangle to surface", angles_text(deviation.angles, ""));
  comparison.largest_distance = std::max(comparison.largest_distance, deviation.distance.max);
}

SphereFit fitted_sphere(const Side& side, const std::string& path) {
  try {
    return fit_sphere(used_positions(side.mesh.X, side.F));
  } catch (const BadMesh& error) {
    throw BadMesh(fmt::format("{}: {}", path, error.what()));
  }
}

void compare_with_sphere(const Side& a, const CompareArguments& arguments, Comparison& comparison) {
  Vec3 center = Vec3::Map(arguments.center.data());
  double radius = 0.0;
  if (arguments.sphere == "fit") {
    const SphereFit fit = fitted_sphere(a, arguments.a);
    center = fit.center;
    radius = fit.radius;
    comparison.json["radius_deviation"] = fit.deviation;
    comparison.list.add("radius deviation", fmt::format("{:.4e} of the radius", fit.deviation));
  } else {
    radius =
        or_other("fit", [&] { return parse_real_option("--sphere", arguments.sphere, positive); });
  }
  compare_with_surface(a, ExactSphere(center, radius),
                       fmt::format("sphere of radius {:.8g} about {:.8g} {:.8g} {:.8g}", radius,
                                   center[0], center[1], center[2]),
                       comparison);
}

void check(const CompareArguments& arguments) {
  const int references = (arguments.b.empty() ? 0 : 1) + (arguments.sphere.empty() ? 0 : 1) +
                         (arguments.torus ? 1 : 0);
  if (references != 1) {
    throw BadOption("compare: name one thing to compare A with: a mesh B, --sphere or --torus");
  }
  if (arguments.a == "-" && arguments.b == "-") {
    throw BadOption("compare: standard input holds one mesh only; name a file for A or B");
  }
}

/// Names the mesh whose area is the reason for an error.
void compare_named(const Side& a, const Side& b, const CompareArguments& arguments,
                   Comparison& comparison) {
  try {
    compare_meshes(a, b, arguments.samples, comparison);
  } catch (const BadMesh& error) {
    const bool in_a = !(a.summary.area > 0 && std::isfinite(a.summary.area));
    throw BadMesh(fmt::format("{}: {}", in_a ? arguments.a : arguments.b, error.what()));
  }
}

/// Compares A with what the arguments name.
void run_comparison(const CompareArguments& arguments, const Side& a, const Host& host,
                    Comparison& comparison) {
  if (!arguments.b.empty()) {
    comparison.json["b"] = arguments.b;
    compare_named(a, read_side(arguments.b, arguments.input, host), arguments, comparison);
  } else if (!arguments.sphere.empty()) {
    compare_with_sphere(a, arguments, comparison);
  } else {
    const double axis_radius = arguments.torus->at(0);
    const double tube_radius = arguments.torus->at(1);
    compare_with_surface(
        a, ExactTorus(Vec3::Map(arguments.center.data()), axis_radius, tube_radius),
        fmt::format("torus of radii {:.8g} and {:.8g}", axis_radius, tube_radius), comparison);
  }
}

ExitCode run_compare(const CompareArguments& arguments, const CLI::App& app, const Host& host) {
  check(arguments);
  check_reports(arguments.report, {}, arguments.overwrite);
  const Side a = read_side(arguments.a, arguments.input, host);
  Report report(app);
  Comparison comparison{report.figures, {}, 0.0};
  comparison.json["a"] = arguments.a;
  run_comparison(arguments, a, host, comparison);

  const bool within = !arguments.tolerance || comparison.largest_distance <= *arguments.tolerance;
  if (arguments.tolerance) {
    comparison.json["tolerance"] = *arguments.tolerance;
    comparison.json["within_tolerance"] = within;
  }
  host.deliver(arguments.report, arguments.overwrite, report);
  if (!arguments.report.json) {
    write_standard_output(comparison.list.text());
  }
  if (!within) {
    host.console().note(fmt::format("the largest distance {:.6g} is above the tolerance {:.6g}",
                                    comparison.largest_distance, *arguments.tolerance));
  }
  return within ? ExitCode::done : ExitCode::not_reached;
}

void add_meshes(CLI::App& app, CompareArguments& a) {
  CLI::Option* first = app.add_option("A", a.a, "mesh file to read; - is standard input")
                           ->type_name(file_to_read)
                           ->required();
  CLI::Option* second =
      app.add_option("B", a.b, "mesh file to compare A with")->type_name(file_to_read);
  offer_meshes_to_read(app, *first);
  offer_meshes_to_read(app, *second);
}

void add_surfaces(CLI::App& app, CompareArguments& a) {
  begin_group(app, "An exact surface instead of B");
  CLI::Option* sphere =
      app.add_option("--sphere", a.sphere,
                     "compare A with the sphere of this radius, or with the sphere that fits best")
          ->type_name("R|fit");
  note_of(app, *sphere).offers = {"fit"};
  CLI::Option* torus = add_parsed_option(app, "--torus", "R,r",
                                         "compare A with the torus about the z axis whose tube has "
                                         "the radius r and its centre line the radius R",
                                         [&a](const std::string& text) {
                                           a.torus =
                                               parse_reals_option("--torus", text, 2, positive);
                                         });
  CLI::Option* center = add_parsed_option(
      app, "--center", "X,Y,Z", "centre of the sphere or torus", [&a](const std::string& text) {
        a.center = parse_reals_option("--center", text, 3, any_real);
      });
  note_of(app, *center).default_text = "0,0,0";
  for (const CLI::Option* option : {sphere, torus, center}) {
    note_of(app, *option).unit = "mesh units";
  }
}

void add_measures(CLI::App& app, CompareArguments& a) {
  begin_group(app, "How to measure");
  CLI::Option* samples =
      add_integer(app, "--samples", a.samples, std::int64_t{1}, std::int64_t{100'000'000},
                  "number of points on each surface at which the distance is measured");
  note_of(app, *samples).unit = "points";
  CLI::Option* tolerance =
      add_real(app, "--tolerance", a.tolerance, not_negative,
               "exit with code 1 if the largest distance between the surfaces is above this");
  note_of(app, *tolerance).unit = "mesh units";
  note_of(app, *tolerance).default_text = "no limit";
}

}  // namespace

Runner declare_compare(CLI::App& app) {
  auto arguments = std::make_shared<CompareArguments>();
  CompareArguments* const a = arguments.get();
  add_meshes(app, *a);
  add_surfaces(app, *a);
  add_measures(app, *a);
  add_input_options(app, a->input);
  add_report_options(app, a->report);
  add_overwrite_option(app, a->overwrite);
  documentation_of(app).examples = {
      {"ibmfair compare scan.ply fair.ply --tolerance 0.5",
       "prints the distances of the two, with exit code 1 if the largest is more than 0.5"},
      {"ibmfair compare ball.ply --sphere fit",
       "prints the distances to the sphere that fits best"},
  };
  return [arguments, &app](Host& host) { return run_compare(*arguments, app, host); };
}

}  // namespace ibmfair::commands
