#include "commands/smooth_arguments.h"

#include <vector>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/numeric_options.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/jacobian_solver.h"

namespace ibmfair::commands {
namespace {

std::vector<std::string> solver_names() {
  std::vector<std::string> names{"auto"};
  for (const JacobianBackend& backend : jacobian_backends()) {
    names.emplace_back(backend.name);
  }
  return names;
}

std::vector<std::string> laplacian_names() {
  std::vector<std::string> names;
  for (const BendingModel& model : bending_models()) {
    names.emplace_back(model.name);
  }
  return names;
}

void add_flow_options(CLI::App& app, SmoothArguments& a) {
  constexpr int most = 1'000'000;
  add_integer(app, "--steps", a.flow.steps, 0, most,
              "time steps (default 16; 0 writes the mesh as it was read)");
  auto* cutoff =
      add_length(app, "--cutoff", a.cutoff, Length::Unit::edges,
                 "smooth ripples up to about this wavelength, in all steps together: in "
                 "mean edge lengths, or with % of the bounding box's diagonal, or with u "
                 "in the mesh's units (default: 8 for 16 steps, more with more steps)");
  add_real(app, "--time-step", a.time_step, positive,
           "time of one step instead: length^4 (--metric mass) or length^2 (identity)")
      ->excludes(cutoff);
  app.add_option("--laplacian", a.flow.laplacian, "member of the family of energies")
      ->check(CLI::IsMember(laplacian_names()))
      ->capture_default_str();
  app.add_flag("--no-mass", a.no_mass, "leave the mass matrix out of the energy");
  app.add_option("--metric", a.metric, "of the flow: mass (independent of sampling) or identity")
      ->check(CLI::IsMember({"mass", "identity"}))
      ->capture_default_str();
  add_integer(app, "--newton-iterations", a.flow.newton_iterations, 1, 1000,
              "inexact Newton iterations per step (default 1)");
  app.add_option("--solver", a.flow.solver,
                 "of the linear systems: cholmod (factored), cg (conjugate gradients: least "
                 "memory) or auto (the one predicted to be quicker)")
      ->check(CLI::IsMember(solver_names()))
      ->capture_default_str();
  add_real(app, "--solver-tolerance", a.flow.solver_tolerance, positive,
           "residual at which conjugate gradients stop, of what it was: 0.3 halves the time, and "
           "leaves ripples near the cut-off where there are few steps (default 0.05)");
  add_bytes(
      app, "--memory", a.flow.memory_limit,
      "memory that the program may take, as in 800M or 4G: auto takes a solver that fits, and "
      "what fits with none is refused before the first step (default: what there is)");
  app.add_flag("--dry-run", a.dry_run,
               "print what time and memory it would take, and write no mesh");
  app.add_option("--tangential", a.tangential,
                 "relax or none: even out vertices within the surface after each step (default "
                 "relax; none where the mesh has texture coordinates)")
      ->check(CLI::IsMember({"relax", "none"}));
  app.add_flag("--plain", a.plain, "the published scheme: no guard, no relaxation");
}

void add_constraint_options(CLI::App& app, SmoothArguments& a) {
  app.add_option("--boundary", a.boundary,
                 "open boundaries: fixed (two rings of vertices), position (one) or free")
      ->check(CLI::IsMember({"fixed", "position", "free"}))
      ->capture_default_str();
  app.add_option("--fix", a.fix_file, "hold the vertices listed in this file, counted from 0")
      ->type_name(file_to_read);
  app.add_option("--mask", a.mask,
                 "move only the vertices of this OBJ group, object or material, or those whose PLY "
                 "property of this name is not zero")
      ->type_name("NAME");
  add_length(
      app, "--max-move", a.max_move, Length::Unit::absolute,
      "move no vertex further than this from where it was: in the mesh's units, or with e in "
      "mean edge lengths, or with % of the bounding box's diagonal");
}

}  // namespace

void add_smooth_arguments(CLI::App& app, SmoothArguments& a) {
  app.add_option("IN", a.input, "mesh file to read; - is standard input")->required();
  add_output_options(app, a.output);
  add_flow_options(app, a);
  add_constraint_options(app, a);
  add_input_options(app, a.reading);
  add_strict_option(app, a.strict);
  add_report_options(app, a.report);
  add_picture_options(app, "the mesh before and after", a.picture);
  app.add_option("--checkpoint", a.checkpoint,
                 "when interrupted (Ctrl-C), end after the time step and write the mesh that was "
                 "reached to this file instead of OUT")
      ->type_name(file_to_write)
      ->configurable(false);  // a batch starts its files again
  add_overwrite_option(app, a.output.write.overwrite);
}

}  // namespace ibmfair::commands
