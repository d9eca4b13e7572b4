#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/crack_summary.h"
#include "commands/defect_warnings.h"
#include "commands/fill_arguments.h"
#include "commands/fill_picture.h"
#include "commands/fill_report.h"
#include "commands/mesh_statistics.h"
#include "commands/page/mesh_scene.h"
#include "commands/progress.h"
#include "commands/report/reading.h"
#include "commands/report/report_formats.h"
#include "commands/stitch_cracks.h"
#include "commands/value_list.h"
#include "commands/vertex_list.h"
#include "ibmfair/base/angle.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/fill/fill_region.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/page/scene_lines.h"

namespace ibmfair::commands {
namespace {

/// The region that contains all vertices except the two rings along open boundaries.
constexpr const char* everything = "@all";

/// The input of both ways of running: filling holes and fairing a region.
struct Input {
  MeshFile file;
  Triangulation triangulation;
  Topology topology;
};

FillOptions fill_options(const FillArguments& arguments) {
  FillOptions options = arguments.fill;
  options.fair = !arguments.no_fair;
  options.refine = !arguments.no_refine;
  options.fairing.mass = arguments.mass.mass();
  options.fairing.mass_matrix = arguments.mass.name;
  options.choose_by_surroundings =
      !arguments.laplacian_is_given() && arguments.mass.name.empty() && !arguments.mass.without;
  options.continuity = continuity_of(arguments);
  options.fairing.relax = arguments.tangential == "relax";
  if (arguments.keep_sharp) {
    options.sharp_angle = radians(*arguments.keep_sharp);
  }
  return options;
}

/// The options of the run, with their lengths in the units of the mesh.
FillOptions options_on(const FillArguments& arguments, const Points& X, const Topology& topology) {
  FillOptions options = fill_options(arguments);
  if (arguments.edge_length) {
    options.edge_length = arguments.edge_length->on(X, topology);
  }
  return options;
}

HoleChoice hole_choice(const FillArguments& arguments, const Points& X, const Topology& topology) {
  HoleChoice choice = arguments.choice;
  if (arguments.max_perimeter) {
    choice.longest_perimeter = arguments.max_perimeter->on(X, topology);
  }
  if (arguments.max_diameter) {
    choice.largest_diameter = arguments.max_diameter->on(X, topology);
  }
  return choice;
}

/// Reads the region from a file of vertex numbers, or from the mesh file by its name there. An OBJ
/// group also contains the vertices that it shares with neighbouring groups; these vertices are the
/// inner ring of fixed vertices, so they are left out of the region.
std::vector<std::uint8_t> region_of(const FillArguments& arguments, const Input& input) {
  if (arguments.region == everything) {
    std::vector<std::uint8_t> region = fixed_vertices(input.topology, BoundaryCondition::fixed);
    for (std::uint8_t& flag : region) {
      flag = flag ? 0 : 1;
    }
    return region;
  }
  if (std::filesystem::is_regular_file(arguments.region)) {
    std::vector<std::uint8_t> region(static_cast<std::size_t>(input.topology.vertex_count), 0);
    for (const Index v :
         read_vertex_list("--region", arguments.region, input.topology.vertex_count)) {
      region[v] = 1;
    }
    return region;
  }
  const std::vector<std::uint8_t> named = input.file.vertex_mask(arguments.region);
  return input.file.format().name == "obj" ? inner_vertices(input.topology, named) : named;
}

Extension extension_of(const Filling& filling, const Triangulation& triangulation) {
  Extension extension;
  extension.X = filling.new_X;
  extension.F = filling.new_F;
  for (const Index triangle : filling.model_triangle) {
    extension.model_face.push_back(triangulation.face[triangle]);
  }
  extension.rim = filling.rim();
  extension.extend = [&filling](const Eigen::MatrixXd& at_rim) { return filling.extend(at_rim); };
  return extension;
}

void tell(const WriteReport& written, const Console& console) {
  for (const std::string& note : written.notes) {
    console.note(note);
  }
}

/// The filled mesh if a picture or page shows it; else empty.
struct ShownMesh {
  Points X;
  Topology topology;
};

ShownMesh shown_mesh(const FillArguments& arguments, const Topology& topology,
                     const Filling& filling) {
  if (arguments.picture.path.empty() && !wants_page(arguments.report)) {
    return {};
  }
  FilledMesh filled = filled_mesh(topology, filling);
  Topology filled_topology = build_topology(filled.X, std::move(filled.F));
  return {std::move(filled.X), std::move(filled_topology)};
}

/// The figures of one of the two states (before and after) that a page shows.
nlohmann::ordered_json state_json(const FillArguments& arguments, const SceneState& state) {
  const FlowOptions options = fill_options(arguments).fairing.flow_options();
  return mesh_state_json(*state.X, *state.topology, options);
}

/// Completes and writes the report. `after` begins with the vertices and triangles of the input.
void deliver(const FillArguments& arguments, const Input& input, const SceneState& after,
             const SceneSource& marks, Report& report, const Host& host) {
  const SceneState before{"before", &input.file.mesh().X, &input.topology};
  report.figures["defects"] = defects_json(input.topology);
  if (wants_page(arguments.report)) {
    report.figures["before"] = state_json(arguments, before);
    report.figures["after"] = state_json(arguments, after);
  }
  report.scene = [&] {
    SceneSource source = marks;
    source.name = arguments.input;
    source.states = {before, after};
    source.laplacian = arguments.fill.fairing.laplacian;
    source.polygons = &input.file.mesh().faces;
    return mesh_scene(std::move(source), report.warnings, host.console());
  };
  host.deliver(arguments.report, arguments.output.write.overwrite, report);
}

void deliver(const FillArguments& arguments, const Input& input, const Filling& filling,
             const ShownMesh& shown, const std::vector<Hole>& holes, Report& report,
             const Host& host) {
  SceneSource marks;
  marks.patch = filling.hole_of_triangle;
  for (const HoleReport& hole : filling.holes) {
    if (hole.new_triangles > 0) {
      marks.lines.push_back(seam_line(filling.X, holes[static_cast<std::size_t>(hole.hole)]));
    }
  }
  deliver(arguments, input, {"after", &shown.X, &shown.topology}, marks, report, host);
}

void deliver_region(const FillArguments& arguments, const Input& input, const Points& X,
                    const std::vector<std::uint8_t>& region, Report& report, const Host& host) {
  std::vector<std::uint8_t> fixed(region.size());
  std::transform(region.begin(), region.end(), fixed.begin(),
                 [](std::uint8_t chosen) { return chosen ? 0 : 1; });
  SceneSource marks;
  marks.lines = fixed_lines(X, input.topology, fixed);
  deliver(arguments, input, {"after", &X, &input.topology}, marks, report, host);
}

/// A bridge can join pieces of opposite orientations. The triangles of the file stay as they are.
void warn_of_orientation(const FillArguments& arguments, const Input& input, const Filling& filling,
                         Report& report, const Console& console) {
  if (arguments.choice.bridges.empty()) {
    return;
  }
  Points X(filling.X.rows() + filling.new_X.rows(), 3);
  X << filling.X, filling.new_X;
  Triangles F(input.triangulation.F.rows() + filling.new_F.rows(), 3);
  F << input.triangulation.F, filling.new_F;
  const Index turned = build_topology(X, std::move(F)).turned_triangles;
  if (turned > input.topology.turned_triangles) {
    report.warnings.push_back(
        {fmt::format("--bridge joins pieces of opposite orientations: in {}, {} triangles are "
                     "oriented against the others",
                     arguments.output.path, turned)});
    console.warning(report.warnings.back().text);
  }
}

ExitCode conclude(const std::string& missed, bool strict, Report& report, const Console& console) {
  if (missed.empty()) {
    return ExitCode::done;
  }
  report.warnings.push_back({missed + (strict ? "; no mesh was written (--strict)" : "")});
  console.warning(report.warnings.back().text);
  return ExitCode::not_reached;
}

Filling fill_within_memory(const FillArguments& arguments, const Input& input, Progress& progress) {
  const Points& X = input.file.mesh().X;
  FillOptions options = options_on(arguments, X, input.topology);
  progress.begin_work("triangulate");
  options.on_hole = [&progress](std::int64_t finished, std::int64_t all) {
    if (finished < all) {
      progress.advance(fmt::format("hole {} of {}", finished + 1, all),
                       static_cast<double>(finished) / static_cast<double>(all));
    } else {
      progress.begin("check for intersections");
    }
  };
  try {
    return fill_holes(X, input.topology, hole_choice(arguments, X, input.topology), options);
  } catch (const OutOfMemory& error) {
    throw OutOfMemory(fmt::format(
        "{}; coarser patches (--max-new-vertices N) or fewer holes (--only, --max-edges) need less",
        error.what()));
  }
}

ExitCode fill(const FillArguments& arguments, const Input& input, FillSeconds& seconds,
              Report& report, const Host& host, Progress& progress) {
  const Console& console = host.console();
  const Points& X = input.file.mesh().X;
  Filling filling;
  {
    const Stopwatch watch(seconds.fill);
    filling = fill_within_memory(arguments, input, progress);
  }
  seconds.audit = filling.audit_seconds;
  seconds.fill -= filling.audit_seconds;
  const std::string missed = shortfall(filling, arguments.allow_intersections);
  const ShownMesh shown = shown_mesh(arguments, input.topology, filling);
  if (missed.empty() || !arguments.strict) {
    const Stopwatch watch(seconds.write);
    progress.begin("write");
    tell(filling.new_F.rows() > 0
             ? host.write(input.file, filling.X, extension_of(filling, input.triangulation),
                          arguments.output)
             : host.write(input.file, X, arguments.output),
         console);
    draw_filling(arguments, X, input.topology, filling, shown.X, shown.topology);
  }
  progress.end();
  const std::vector<Hole> holes = find_holes(X, input.topology);
  const CrackSummary cracks = summarise_cracks(input.file.mesh(), input.topology, holes);
  for (const std::string& note : crack_notes(cracks)) {
    console.note(note);
  }
  report.figures["cracks"] = crack_json(cracks);
  warn_of_orientation(arguments, input, filling, report, console);
  add_filling(filling, holes, seconds, report);
  const auto filled = std::count_if(filling.holes.begin(), filling.holes.end(),
                                    [](const HoleReport& hole) { return hole.new_triangles > 0; });
  if (!filling.fins.empty()) {
    console.note(
        fmt::format("{} on edges of three or more triangles, such as {}: left aside",
                    counted(std::ssize(filling.fins), "triangle stands", "triangles stand"),
                    filling.fins.front()));
  }
  if (filling.holes.empty()) {
    console.note(fmt::format("{}{}: no holes{}", arguments.input,
                             arguments.stitch ? " -> " + arguments.output.path : "",
                             filling.fins.empty() ? ", the mesh is closed" : ""));
  } else {
    console.note(fmt::format("{} -> {}, {} of {} holes filled: {} new vertices, {} new triangles",
                             arguments.input, arguments.output.path, filled, filling.holes.size(),
                             filling.new_X.rows(), filling.new_F.rows()),
                 fill_text(filling, seconds, console.level() == Console::Level::verbose));
    if (filled == 0 && std::any_of(holes.begin(), holes.end(),
                                   [](const Hole& hole) { return hole.outer_border; })) {
      console.note("outer borders of open sheets stay open; --all fills them");
    }
  }
  const ExitCode code = conclude(missed, arguments.strict, report, console);
  deliver(arguments, input, filling, shown, holes, report, host);
  return code;
}

ExitCode fair_again(const FillArguments& arguments, const Input& input, FillSeconds& seconds,
                    Report& report, const Host& host, Progress& progress) {
  const Console& console = host.console();
  Points X = input.file.mesh().X;
  const std::vector<std::uint8_t> chosen = region_of(arguments, input);
  RegionReport region;
  {
    const Stopwatch watch(seconds.fill);
    progress.begin("fair the region");
    region = fair_region(X, input.topology, chosen, fill_options(arguments).fairing);
  }
  std::string missed;
  if (!region.fairing.converged) {
    missed = "the fairing did not reach its tolerance; a larger --max-steps takes it further";
  } else if (region.folds > 0) {
    missed = fmt::format("{} hinges of the region are folded", region.folds);
  }
  if (missed.empty() || !arguments.strict) {
    const Stopwatch watch(seconds.write);
    progress.begin("write");
    tell(host.write(input.file, X, arguments.output), console);
    draw_region(arguments, input.file.mesh().X, input.topology, X);
  }
  progress.end();
  add_region(region, seconds, report);
  console.note(fmt::format("{} -> {}, region '{}' faired", arguments.input, arguments.output.path,
                           arguments.region),
               region_text(region, seconds, console.level() == Console::Level::verbose));
  const ExitCode code = conclude(missed, arguments.strict, report, console);
  deliver_region(arguments, input, X, chosen, report, host);
  return code;
}

void connect_input(Input& input) {
  input.triangulation = triangulate(input.file.mesh());
  input.topology = build_topology(input.file.mesh().X, input.triangulation.F);
}

Input read(const FillArguments& arguments, FillSeconds& seconds, const Host& host,
           Progress& progress) {
  Input input;
  progress.begin("read");
  {
    const Stopwatch watch(seconds.read);
    input.file = read_input(arguments.input, arguments.reading, host);
  }
  progress.begin("connect");
  const Stopwatch watch(seconds.topology);
  connect_input(input);
  return input;
}

ExitCode run_fill(const FillArguments& given, const CLI::App& app, Host& host) {
  const Console& console = host.console();
  FillArguments arguments = given;
  check_fill_arguments(arguments);
  check_reports(arguments.report,
                {{"", arguments.output.path}, {"--picture", arguments.picture.path}},
                arguments.output.write.overwrite);
  FillSeconds seconds;
  Progress progress(console);
  Input input = read(arguments, seconds, host, progress);
  host.require_writable(input.file, arguments.output);
  Report report(app);
  report.figures["input"] = arguments.input;
  report.figures["output"] = arguments.output.path;
  add_reading(input.file, report);
  if (arguments.stitch) {
    if (arguments.output.write.format.empty() && path_extension(arguments.output.path).empty()) {
      arguments.output.write.format = input.file.format().name;
    }
    input.file = stitch_cracks(input.file, input.topology, arguments.stitch_reach, report, console);
    connect_input(input);
  }
  warn_of_defects(input.topology, arguments.strict, console);
  std::ranges::move(defect_list(input.file.mesh().X, input.topology),
                    std::back_inserter(report.warnings));
  return arguments.region.empty() ? fill(arguments, input, seconds, report, host, progress)
                                  : fair_again(arguments, input, seconds, report, host, progress);
}

}  // namespace

Runner declare_fill(CLI::App& app) {
  auto arguments = std::make_shared<FillArguments>();
  add_fill_arguments(app, *arguments);
  return [arguments, &app](Host& host) { return run_fill(*arguments, app, host); };
}

}  // namespace ibmfair::commands
