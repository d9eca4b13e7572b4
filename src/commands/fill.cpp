#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/command.h"
#include "commands/defect_warnings.h"
#include "commands/fill_arguments.h"
#include "commands/fill_report.h"
#include "commands/progress.h"
#include "commands/vertex_list.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/fill/fill_region.h"
#include "ibmfair/flow/held_vertices.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/io/formats.h"

namespace ibmfair::commands {
namespace {

/// The region of all vertices but the two rings along open boundaries.
constexpr const char* everything = "@all";

/// What both ways of running share.
struct Input {
  MeshFile file;
  Triangulation triangulation;
  Topology topology;
};

FillOptions fill_options(const FillArguments& arguments) {
  FillOptions options = arguments.fill;
  options.fair = !arguments.no_fair;
  options.refine = !arguments.no_refine;
  options.fairing.mass = !arguments.no_mass;
  options.fairing.relax = arguments.tangential == "relax";
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

/// A file of vertex numbers, or the name of something in the mesh file. The vertices of an OBJ
/// group include those that it shares with its neighbours: they are the inner ring that stays.
std::vector<std::uint8_t> region_of(const FillArguments& arguments, const Input& input) {
  if (arguments.region == everything) {
    std::vector<std::uint8_t> region = held_vertices(input.topology, BoundaryCondition::fixed);
    for (std::uint8_t& flag : region) {
      flag = flag ? 0 : 1;
    }
    return region;
  }
  if (std::filesystem::is_regular_file(arguments.region)) {
    std::vector<std::uint8_t> region(static_cast<std::size_t>(input.topology.vertex_count), 0);
    for (const Index v : read_vertex_list(arguments.region, input.topology.vertex_count)) {
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

/// What was asked for and not achieved, as one sentence; empty if everything was.
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
  add(rough, "not brought to the end");
  add(folds, "folded hinges");
  add(allow_intersections ? 0 : intersections, "intersecting pairs of triangles");
  return parts.empty() ? std::string() : fmt::format("holes: {}", fmt::join(parts, ", "));
}

void tell(const WriteReport& written, const Console& console) {
  for (const std::string& note : written.notes) {
    console.note(note);
  }
}

void draw(const FillArguments& arguments, const Points& before, const Topology& topology,
          const Points& after, const Topology& topology_after) {
  const std::string& laplacian = arguments.fill.fairing.laplacian;
  const std::array<FieldState, 2> states{
      {{before, topology, nullptr, laplacian}, {after, topology_after, &before, laplacian}}};
  draw_picture(arguments.picture, arguments.output.write.overwrite, states, topology.F.rows());
}

void draw(const FillArguments& arguments, const Input& input, const Filling& filling) {
  if (arguments.picture.path.empty()) {
    return;
  }
  const Topology& topology = input.topology;
  Points X(filling.X.rows() + filling.new_X.rows(), 3);
  X << filling.X, filling.new_X;
  Triangles F(topology.F.rows() + filling.new_F.rows(), 3);
  F << topology.F, filling.new_F;
  draw(arguments, input.file.mesh().X, topology, X, build_topology(X, F));
}

ExitCode conclude(const std::string& missed, bool strict, const Console& console) {
  if (missed.empty()) {
    return ExitCode::done;
  }
  console.warning(missed + (strict ? "; nothing was written (--strict)" : ""));
  return ExitCode::not_reached;
}

Filling fill_within_memory(const FillArguments& arguments, const Input& input, Progress& progress) {
  const Points& X = input.file.mesh().X;
  FillOptions options = fill_options(arguments);
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
              nlohmann::ordered_json& report, Console& console, Progress& progress) {
  const Points& X = input.file.mesh().X;
  Filling filling;
  {
    const Stopwatch watch(seconds.fill);
    filling = fill_within_memory(arguments, input, progress);
  }
  seconds.audit = filling.audit_seconds;
  seconds.fill -= filling.audit_seconds;
  const std::string missed = shortfall(filling, arguments.allow_intersections);
  if (missed.empty() || !arguments.strict) {
    const Stopwatch watch(seconds.write);
    progress.begin("write");
    tell(filling.new_F.rows() > 0
             ? write_mesh(input.file, filling.X, extension_of(filling, input.triangulation),
                          arguments.output.path, arguments.output.write)
             : write_mesh(input.file, X, arguments.output.path, arguments.output.write),
         console);
    draw(arguments, input, filling);
  }
  progress.end();
  const std::vector<Hole> holes = find_holes(X, input.topology);
  const auto touching = std::count_if(holes.begin(), holes.end(),
                                      [](const Hole& hole) { return hole.touches_itself; });
  if (touching > 0) {
    console.note(
        fmt::format("{} of the holes meet a place twice as different vertices; --weld "
                    "joins those, and mostly fills such holes better",
                    touching));
  }
  add_filling(report, filling, holes, seconds);
  const auto filled = std::count_if(filling.holes.begin(), filling.holes.end(),
                                    [](const HoleReport& hole) { return hole.new_triangles > 0; });
  if (filling.holes.empty()) {
    console.note(fmt::format("{}: no holes, the mesh is closed", arguments.input));
  } else {
    console.note(fmt::format("{} -> {}, {} of {} holes filled: {} new vertices, {} new triangles",
                             arguments.input, arguments.output.path, filled, filling.holes.size(),
                             filling.new_X.rows(), filling.new_F.rows()),
                 fill_text(filling, seconds, console.level() == Console::Level::verbose));
  }
  return conclude(missed, arguments.strict, console);
}

ExitCode fair_again(const FillArguments& arguments, const Input& input, FillSeconds& seconds,
                    nlohmann::ordered_json& report, Console& console, Progress& progress) {
  Points X = input.file.mesh().X;
  RegionReport region;
  {
    const Stopwatch watch(seconds.fill);
    progress.begin("fair the region");
    region = fair_region(X, input.topology, region_of(arguments, input),
                         fill_options(arguments).fairing);
  }
  std::string missed;
  if (!region.fairing.converged) {
    missed = "the fairing did not reach its tolerance";
  } else if (region.folds > 0) {
    missed = fmt::format("{} hinges of the region are folded", region.folds);
  }
  if (missed.empty() || !arguments.strict) {
    const Stopwatch watch(seconds.write);
    progress.begin("write");
    tell(write_mesh(input.file, X, arguments.output.path, arguments.output.write), console);
    draw(arguments, input.file.mesh().X, input.topology, X, input.topology);
  }
  progress.end();
  add_region(report, region, seconds);
  console.note(fmt::format("{} -> {}, region '{}' faired", arguments.input, arguments.output.path,
                           arguments.region),
               region_text(region, seconds, console.level() == Console::Level::verbose));
  return conclude(missed, arguments.strict, console);
}

Input read(const FillArguments& arguments, FillSeconds& seconds, Console& console,
           Progress& progress) {
  Input input;
  progress.begin("read");
  {
    const Stopwatch watch(seconds.read);
    input.file = read_input(arguments.input, arguments.reading, console);
  }
  progress.begin("connect");
  const Stopwatch watch(seconds.topology);
  input.triangulation = triangulate(input.file.mesh());
  input.topology = build_topology(input.file.mesh().X, input.triangulation.F);
  return input;
}

ExitCode run_fill(const FillArguments& arguments, Console& console) {
  const bool overwrite = arguments.output.write.overwrite;
  require_writable(arguments.output.path, overwrite);
  check_report(arguments.report, arguments.output.path, overwrite);
  check_picture(arguments.picture, overwrite);
  FillSeconds seconds;
  Progress progress(console);
  const Input input = read(arguments, seconds, console, progress);
  require_writable_format(input.file, arguments.output.path, arguments.output.write);
  warn_of_defects(input.topology, arguments.strict, console);
  nlohmann::ordered_json report = start_report("fill");
  report["input"] = arguments.input;
  report["output"] = arguments.output.path;
  const ExitCode code = arguments.region.empty()
                            ? fill(arguments, input, seconds, report, console, progress)
                            : fair_again(arguments, input, seconds, report, console, progress);
  report["defects"] = defects_json(input.topology);
  deliver_report(arguments.report, overwrite, report);
  return code;
}

}  // namespace

Runner declare_fill(CLI::App& app) {
  auto arguments = std::make_shared<FillArguments>();
  add_fill_arguments(app, *arguments);
  return [arguments](Console& console) { return run_fill(*arguments, console); };
}

}  // namespace ibmfair::commands
