#include "commands/smooth_arguments.h"

#include <vector>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/denoise_defaults.h"
#include "commands/documentation.h"
#include "commands/engine.h"
#include "commands/numeric_options.h"
#include "ibmfair/flow/jacobian_solver.h"

namespace ibmfair::commands {
namespace {

std::vector<std::string> solver_names() {
  std::vector<std::string> names{"auto"};
  for (const JacobianBackend& backend : jacobian_backends()) {
    names.emplace_back(backend.name);
  }
  names.emplace_back("mumps");
  return names;
}

void add_amount_options(CLI::App& app, SmoothArguments& a) {
  constexpr int most = 1'000'000;
  begin_group(app, "How much to smooth");
  add_denoise_flag(app, a);
  CLI::Option* cutoff = add_parsed_option(
      app, "--cutoff", "LENGTH|auto",
      "smooth ripples up to about this wavelength, in all steps together; auto tries several and "
      "takes that which by the noise of the mesh leaves least error",
      [&a](const std::string& text) {
        a.cutoff_auto = text == "auto";
        a.cutoff.reset();
        if (!a.cutoff_auto) {
          a.cutoff = parse_length_option("--cutoff", text, Length::Unit::edges);
        }
      });
  note_units_of_length(app, *cutoff, Length::Unit::edges);
  note_of(app, *cutoff).default_text = "8e for 16 steps, more with more steps";
  CLI::Option* steps =
      add_integer(app, "--steps", a.flow.steps, 0, most,
                  "time steps, where noise does not ask for shorter ones first; 0 writes the "
                  "mesh as it was read");
  note_of(app, *steps).unit = "steps";
  CLI::Option* time_step = add_real(app, "--time-step", a.time_step, positive,
                                    "time of one step, in place of a cut-off for all of them");
  time_step->excludes(cutoff)->excludes("--denoise");
  note_of(app, *time_step).unit = "mesh units^4, or mesh units^2 with --metric identity";
  note_of(app, *time_step).default_text = "what --cutoff makes of it";
  CLI::Option* max_move = add_length(app, "--max-move", a.max_move, Length::Unit::absolute,
                                     "move no vertex further than this from where it was");
  note_of(app, *max_move).default_text = "no limit";
}

void add_flow_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, groups::energy_and_flow);
  add_laplacian_option(
      app, a.flow.laplacian,
      "member of the family of energies: crouzeix-raviart removes folded spikes best, "
      "lagrange is consistent, for stationary limits");
  CLI::Option* h0 =
      app.add_option("--h0", a.h0,
                     "spontaneous curvature, of the energy 1/2 integral (H - H0)^2: a number, a "
                     "vertex property or a text file with a number a vertex; positive where the "
                     "sphere bulges outward, with --laplacian lagrange")
          ->type_name(name_or_file_to_read);
  note_of(app, *h0).unit = "1 / mesh units";
  note_of(app, *h0).default_text = "0";
  CLI::Option* anisotropy = add_parsed_option(
      app, "--anisotropy", "X,Y,Z,FACTOR",
      "the curvature along this direction, laid onto the surface as it is without noise, counts "
      "FACTOR times: energy 1/2 integral (FACTOR kappa_1 + kappa_2)^2, with --laplacian lagrange",
      [&a](const std::string& text) {
        a.anisotropy = parse_reals_option("--anisotropy", text, 4, any_real);
      });
  note_of(app, *anisotropy).default_text = "none";
  add_mass_options(app, a.mass);
  app.add_option("--metric", a.metric,
                 "of the flow: mass (independent of the sampling; valences with --mass valence) or "
                 "identity")
      ->check(CLI::IsMember({"mass", "identity"}))
      ->capture_default_str();
  CLI::Option* twicing = add_integer(
      app, "--twicing", a.flow.twicing, 0, 100,
      "smooth what was taken away, too, and put it back, so often: bumps and the volume keep their "
      "size, and a --cutoff half as long again takes more noise");
  note_of(app, *twicing).unit = "times";
  CLI::Option* iterations = add_integer(app, "--newton-iterations", a.flow.newton_iterations, 1,
                                        1000, "inexact Newton iterations per step");
  note_of(app, *iterations).unit = "iterations";
  CLI::Option* tangential =
      app.add_option(
             "--tangential", a.tangential,
             "after each step, even out vertices within the surface and lay down those that "
             "stick out of it (relax), only while much noise is taken off before creases are kept "
             "(first), or do not (none), and let --twicing put back how far they slid (keep)")
          ->check(CLI::IsMember({"relax", "first", "none", "keep"}));
  note_of(app, *tangential).default_text =
      "relax; first where the mesh has texture coordinates; none with --plain and with "
      "--laplacian umbrella";
  app.add_flag("--plain", a.plain, "the published scheme: no guard, no relaxation");
}

void add_solver_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, groups::solver_and_memory);
  a.engine = single_engine;
  app.add_option("--engine", a.engine,
                 "single: this process; petsc: all processes that mpirun starts share one mesh, "
                 "and take PETSc's options behind all others")
      ->check(CLI::IsMember({single_engine, petsc_engine}))
      ->capture_default_str();
  app.add_option("--solver", a.flow.solver,
                 "of the linear systems: cholmod (factored once for many steps), cg (conjugate "
                 "gradients: least memory) or auto (the one predicted to be quicker, until cg's "
                 "iterations turn out to cost more); with --engine petsc cg, mumps (factored) or "
                 "auto")
      ->check(CLI::IsMember(solver_names()))
      ->capture_default_str();
  CLI::Option* tolerance =
      add_real(app, "--solver-tolerance", a.flow.solver_tolerance, positive,
               "residual at which conjugate gradients stop: 0.3 halves the time, and leaves "
               "ripples near the cut-off where there are few steps; below 1e-4 a factor is in "
               "double precision");
  note_of(app, *tolerance).unit = "times that of no step at all";
  CLI::Option* memory =
      add_bytes(app, "--memory", a.flow.memory_limit,
                "memory that the program may take, as in 800M or 4G: auto takes a solver that "
                "fits, and what fits with none is refused before the first step");
  note_of(app, *memory).default_text = "what there is";
  app.add_flag("--dry-run", a.dry_run,
               "print what time and memory it would take, and write no mesh");
}

void add_feature_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, "Features to keep");
  CLI::Option* sharp = add_real(app, "--keep-sharp", a.keep_sharp, positive,
                                "keep edges at which the surface turns by more than this angle");
  note_of(app, *sharp).unit = "degrees";
  note_of(app, *sharp).default_text = "none";
  CLI::Option* weights =
      app.add_option("--weights", a.weights,
                     "a factor of the cut-off for each vertex, from a vertex property of the mesh "
                     "or a text file with a number a vertex: 0 holds it, 1 smooths as the rest")
          ->type_name(name_or_file_to_read);
  note_of(app, *weights).default_text = "1 everywhere";
  app.add_flag("--keep-volume", a.flow.keep_volume, "keep the volume of a closed mesh exactly");
  app.add_flag("--keep-area", a.flow.keep_area, "keep the area of a closed mesh exactly");
}

void add_constraint_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, "Which vertices move");
  app.add_option("--boundary", a.boundary,
                 "open boundaries: fixed (two rings of vertices), position (one) or free")
      ->check(CLI::IsMember({"fixed", "position", "free"}))
      ->capture_default_str();
  CLI::Option* fix =
      app.add_option("--fix", a.fix_file,
                     "hold the vertices listed in this text file, by their numbers from 0")
          ->type_name(file_to_read);
  note_of(app, *fix).default_text = "none";
  CLI::Option* mask =
      app.add_option("--mask", a.mask,
                     "move only the vertices of this OBJ group, object or material, or those whose "
                     "PLY property of this name is not zero")
          ->type_name("NAME");
  note_of(app, *mask).default_text = "all move";
}

void add_file_options(CLI::App& app, SmoothArguments& a) {
  add_input_options(app, a.reading);
  add_strict_option(app, a.strict);
  CLI::Option* checkpoint =
      app.add_option("--checkpoint", a.checkpoint,
                     "when interrupted (Ctrl-C or SIGTERM), end after the time step, write the "
                     "mesh that was reached to this file instead of OUT, and say how to go on from "
                     "it; once more ends at once")
          ->type_name(file_to_write)
          ->configurable(false);  // a batch starts its files again
  offer_meshes_to_write(app, *checkpoint);
  add_overwrite_option(app, a.output.write.overwrite);
  add_report_options(app, a.report);
  add_picture_options(app, "the mesh before and after", a.picture);
}

}  // namespace

void add_smooth_arguments(CLI::App& app, SmoothArguments& a) {
  add_input_argument(app, a.input);
  add_output_options(app, a.output);
  add_amount_options(app, a);
  add_feature_options(app, a);
  add_constraint_options(app, a);
  add_flow_options(app, a);
  add_solver_options(app, a);
  add_file_options(app, a);
  documentation_of(app).examples = {
      {"ibmfair smooth scan.ply clean.ply --denoise",
       "removes noise of a strength that nobody knows"},
      {"ibmfair smooth scan.ply fair.ply --cutoff 2% --picture fair.png",
       "removes ripples up to a fiftieth of the mesh's size, and draws it before and after"},
      {"ibmfair smooth part.obj fair.obj --mask blend --max-move 0.5e",
       "moves only the group `blend`, no vertex by more than half a mean edge length"},
  };
}

}  // namespace ibmfair::commands
