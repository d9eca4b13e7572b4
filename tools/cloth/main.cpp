// Cloth on the isometric bending model and on the nonlinear hinge: [W07] section 3.1.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cloth/frames.h"
#include "cloth/sheet_meshes.h"
#include "cloth/timing_table.h"
#include "commands/program.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/measure/matching_meshes.h"
#include "ibmfair/picture/png.h"

namespace ibmfair::cloth {
namespace {

constexpr int frames_in_picture = 3;

struct Arguments {
  std::string scene, bending = "ibm", integrator = "implicit";
  Index vertices = 1600;
  bool irregular = false;
  double seconds = 0, time_step = 0;
  int newton_iterations = StepOptions{}.newton_iterations;
  std::string frames, format = "obj", picture, report;
  bool compare = false, table = false, quick = false;
};

void write_picture(const std::string& path, const Image& image) {
  AtomicFile file(path, true);
  file.write(encode_png(image));
  file.commit();
}

/// The page of `ibmfair view` on the first and the last frame.
void write_report(const Arguments& arguments, std::size_t last) {
  const std::string before = frame_path(arguments.frames, 0, arguments.format);
  const std::string after = frame_path(arguments.frames, last, arguments.format);
  const std::array words{"ibmfair", "view",        before.c_str(), arguments.report.c_str(),
                         "--with",  after.c_str(), "--overwrite",  "--quiet"};
  if (commands::run_program(static_cast<int>(words.size()), words.data()) != 0) {
    throw CannotWrite(fmt::format("{}: no report", arguments.report));
  }
}

std::vector<Points> run(const Arguments& arguments, const SceneRow& row, const Scene& scene,
                        std::string_view bending) {
  StepOptions options;
  options.newton_iterations = arguments.newton_iterations;
  const bool chosen_by_scene = arguments.time_step == 0 && arguments.integrator == "implicit";
  options.time_step = chosen_by_scene ? row.time_step : arguments.time_step;
  const auto stepper =
      integrator(arguments.integrator)
          .create(scene.plate, scene.surroundings, bending_force(bending), options);
  const double length = arguments.seconds > 0 ? arguments.seconds : row.seconds;
  double seconds = 0;
  std::vector<Points> frames;
  {
    const Stopwatch watch(seconds);
    frames = run_frames(scene, *stepper, length);
  }
  fmt::print(
      "{}, {} bending, {} integrator: {} vertices, {:.3g} s in steps of {:.2g} s took {:.2f} s\n",
      row.name, bending, arguments.integrator, scene.start.rows(), length, stepper->time_step(),
      seconds);
  return frames;
}

void compare(const Arguments& arguments, const SceneRow& row, const Scene& scene) {
  std::vector<Points> last;
  for (const BendingForce& force : bending_forces()) {
    last.push_back(run(arguments, row, scene, force.name).back());
  }
  const Statistics distance = vertex_differences(last[0], last[1]);
  const Statistics path = vertex_differences(scene.start, last[0]);
  fmt::print(
      "between the last states: mean {:.2f} %, rms {:.2f} %, largest {:.2f} % of the "
      "sheet's side; the vertices had moved by {:.0f} % (mean) and {:.0f} % (largest)\n",
      100 * distance.mean / sheet_side, 100 * distance.rms / sheet_side,
      100 * distance.max / sheet_side, 100 * path.mean / sheet_side, 100 * path.max / sheet_side);
}

void show(const Arguments& arguments) {
  const SceneRow& row = scene(arguments.scene);
  const auto make = sheet_meshes()[arguments.irregular ? 1 : 0].make;
  const Scene built = row.build(make(arguments.vertices));
  if (arguments.compare) {
    compare(arguments, row, built);
    return;
  }
  const std::vector<Points> frames = run(arguments, row, built, arguments.bending);
  if (!arguments.frames.empty()) {
    write_frames(built, frames, arguments.frames, arguments.format);
  }
  if (!arguments.picture.empty()) {
    write_picture(arguments.picture, picture_of(built, frames, row.view, frames_in_picture));
  }
  if (!arguments.report.empty()) {
    write_report(arguments, frames.size() - 1);
  }
}

template <class Table>
std::string list_of(const Table& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", row.name, row.summary);
  }
  return text;
}

void declare(CLI::App& app, Arguments& a) {
  app.add_option("SCENE", a.scene, list_of(scenes()));
  app.add_option("--bending", a.bending, list_of(bending_forces()))->capture_default_str();
  app.add_option("--integrator", a.integrator, list_of(integrators()))->capture_default_str();
  app.add_option("--vertices", a.vertices, "of the sheet")
      ->check(CLI::Range(16, 1'000'000))
      ->capture_default_str();
  app.add_flag("--irregular", a.irregular, "a Delaunay mesh in place of a grid");
  app.add_option("--seconds", a.seconds, "to simulate, in place of the scene's own")
      ->check(CLI::PositiveNumber);
  app.add_option("--time-step", a.time_step, "seconds, in place of the scene's own")
      ->check(CLI::PositiveNumber);
  app.add_option("--newton-iterations", a.newton_iterations, "at most in an implicit step")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--frames", a.frames, "write 25 meshes a second into this folder");
  app.add_option("--format", a.format, "of the meshes")
      ->check(CLI::IsMember({"obj", "ply", "off"}))
      ->capture_default_str();
  app.add_option("--picture", a.picture, "draw three states into this PNG file");
  app.add_option("--report", a.report, "show the first and the last frame in this HTML file")
      ->needs("--frames");
  app.add_flag("--compare", a.compare, "run both bending models; print how far apart they end");
  auto* table = app.add_flag("--table", a.table, "print the table of [W07] Figure 7");
  app.add_flag("--quick", a.quick, "of the table only up to 2100 vertices")->needs(table);
}

}  // namespace
}  // namespace ibmfair::cloth

// An exception from a message that cannot be printed ends the program, as intended.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app{"Drapes a sheet over a sphere, or lets a flag wave", "drape"};
  ibmfair::cloth::Arguments arguments;
  ibmfair::cloth::declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    if (arguments.table) {
      ibmfair::cloth::print_timing_table(arguments.quick);
    } else if (!arguments.scene.empty()) {
      ibmfair::cloth::show(arguments);
    } else {
      fmt::print("{}", app.help());
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "drape: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
