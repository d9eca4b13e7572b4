#include <cstdint>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/command.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "commands/output_files.h"
#include "commands/shared_options.h"
#include "commands/suggest.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"

namespace ibmfair::commands {

namespace {

struct MakeArguments {
  std::string shape;
  ShapeSettings settings;
  double noise = 0.0;
  std::uint64_t seed = 1;
  double scale = 1.0;
  std::vector<double> move{0.0, 0.0, 0.0};
  OutputOptions output;
};

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const Shape& shape : shapes()) {
    names.emplace_back(shape.name);
  }
  return names;
}

std::string shape_list() {
  std::string text;
  for (const Shape& shape : shapes()) {
    text += fmt::format("{:<16}{}\n", shape.name, shape.summary);
  }
  return text;
}

void require_known(const std::string& shape) {
  const std::vector<std::string> names = shape_names();
  if (std::find(names.begin(), names.end(), shape) == names.end()) {
    throw BadOption(fmt::format("unknown shape '{}'{} (there are {})", shape,
                                suggestion(shape, names), fmt::join(names, ", ")));
  }
}

double mean_edge_length_of(const Mesh& mesh) {
  const Topology topology = build_topology(static_cast<Index>(mesh.X.rows()), triangulate(mesh).F);
  return mean_edge_length(mesh.X, topology.E);
}

ExitCode run_make(const MakeArguments& arguments, const Host& host) {
  const Console& console = host.console();
  require_known(arguments.shape);
  check_output_files({{"", arguments.output.path}}, arguments.output.write.overwrite);
  ShapeSettings settings = arguments.settings;
  settings.seed = arguments.seed;
  Mesh mesh = make_shape(arguments.shape, settings);
  mesh.X *= arguments.scale;
  if (arguments.noise > 0.0) {
    add_noise(mesh.X, arguments.noise * mean_edge_length_of(mesh), arguments.seed);
  }
  mesh.X.rowwise() += Eigen::RowVector3d::Map(arguments.move.data());

  const WriteReport written = host.write(mesh, arguments.output);
  for (const std::string& note : written.notes) {
    console.note(note);
  }
  console.detail(fmt::format("{}: {} vertices, {} faces", arguments.output.path, mesh.X.rows(),
                             mesh.faces.size()));
  return ExitCode::done;
}

void add_shape_settings(CLI::App& app, ShapeSettings& settings) {
  constexpr Index most = std::numeric_limits<Index>::max();
  begin_group(app, "The shape");
  CLI::Option* subdivide = add_integer(app, "--subdivide", settings.subdivide, 0, 64,
                                       "split every triangle of a polyhedron into four");
  note_of(app, *subdivide) = {.unit = "times", .default_text = "0"};
  CLI::Option* face =
      add_integer(app, "--refine-face", settings.refine_face, Index{0}, most,
                  "split the triangles of this face of a polyhedron once more than the others");
  note_of(app, *face) = {.unit = "number of the face, counted from 0", .default_text = "none"};
  CLI::Option* ratio = add_real(app, "--ratio", settings.ratio, positive,
                                "proportion of the shape; the list of shapes says of what");
  note_of(app, *ratio).unit = "ratio of two lengths";
  note_of(app, *ratio).default_text = "the number in the list";
  CLI::Option* rows = add_integer(app, "--rows", settings.rows, Index{1}, most,
                                  "number of rows of vertices of a grid");
  CLI::Option* columns = add_integer(app, "--columns", settings.columns, Index{1}, most,
                                     "number of vertices in each row");
  for (const CLI::Option* option : {rows, columns}) {
    note_of(app, *option).default_text =
        "chosen so that triangles are nearly equilateral; without --rows and --columns, the "
        "smaller of the two is 32";
  }
  note_of(app, *rows).unit = "rows";
  note_of(app, *columns).unit = "vertices";
  app.add_flag("--straight", settings.straight,
               "do not shift every other row by half a cell: triangles are right-angled");
  CLI::Option* jitter = add_real(app, "--jitter", settings.jitter, not_negative,
                                 "move every vertex within the surface at random, by up to this "
                                 "distance (below 0.5): gives triangles of all shapes");
  note_of(app, *jitter) = {.unit = "cells of the grid; on a sphere mean edge lengths",
                           .default_text = "0"};
}

void add_changes(CLI::App& app, MakeArguments& arguments) {
  begin_group(app, "What is done to it");
  CLI::Option* noise = add_real(app, "--noise", arguments.noise, not_negative,
                                "add Gaussian noise of this standard deviation to each coordinate");
  note_of(app, *noise).unit = "mean edge lengths";
  CLI::Option* seed =
      add_integer(app, "--seed", arguments.seed, std::uint64_t{0}, std::uint64_t{1} << 62U,
                  "seed of the random numbers for noise and jitter");
  note_of(app, *seed).unit = "any whole number";
  CLI::Option* scale =
      add_real(app, "--scale", arguments.scale, positive, "multiply all coordinates");
  note_of(app, *scale).unit = "factor";
  CLI::Option* move =
      add_parsed_option(app, "--move", "X,Y,Z", "then move the shape by this vector",
                        [&arguments](const std::string& text) {
                          arguments.move = parse_reals_option("--move", text, 3, any_real);
                        });
  note_of(app, *move) = {.unit = "mesh units", .default_text = "0,0,0"};
}

}  // namespace

Runner declare_make(CLI::App& app) {
  auto arguments = std::make_shared<MakeArguments>();
  CLI::Option* shape =
      app.add_option("SHAPE", arguments->shape, "shape to make (see the list below)")->required();
  note_of(app, *shape).offers = shape_names();
  add_output_options(app, arguments->output);
  add_shape_settings(app, arguments->settings);
  add_changes(app, *arguments);
  add_overwrite_option(app, arguments->output.write.overwrite);
  documentation_of(app).sections = {{"Shapes", shape_list()}};
  documentation_of(app).examples = {
      {"ibmfair make icosphere ball.ply --subdivide 4", "makes a sphere of 2562 vertices"},
      {"ibmfair make torus torus.obj --noise 0.2 --seed 7",
       "makes a torus with noise of a fifth of an edge length; each seed gives other noise"},
  };
  return [arguments](Host& host) { return run_make(*arguments, host); };
}

}  // namespace ibmfair::commands
