#include "commands/smooth_arguments.h"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/denoise_defaults.h"
#include "commands/documentation.h"
#include "commands/engine.h"
#include "commands/numeric_options.h"
#include "commands/smooth_defaults.h"
#include "ibmfair/flow/linear_system/jacobian_solver.h"

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

/// The description of --solver.
std::string solver_summaries() {
  std::string text = "solver of the linear systems: ";
  std::string_view published = "multifrontal";
  for (const JacobianBackend& backend : jacobian_backends()) {
    text += fmt::format("{} ({}), ", backend.name, backend.summary);
    if (backend.name == "cholmod") published = backend.name;
  }
  return text + fmt::format(
                    "or auto (the one that is predicted to be fastest; with --plain {}); "
                    "with --engine petsc: cg, mumps (factorization) or auto",
                    published);
}

void add_amount_options(CLI::App& app, SmoothArguments& a) {
  constexpr int most = 1'000'000;
  begin_group(app, "How much to smooth");
  add_denoise_flag(app, a);
  CLI::Option* cutoff = add_parsed_option(
      app, "--cutoff", "LENGTH|auto",
      "the wavelength up to which ripples are smoothed away, by all steps together; auto estimates "
      "the noise of the mesh and chooses the cut-off that leaves the least error",
      [&a](const std::string& text) {
        a.cutoff_auto = text == "auto";
        a.cutoff.reset();
        if (!a.cutoff_auto) {
          a.cutoff = parse_length_or("--cutoff", text, Length::Unit::edges, "auto");
        }
      });
  note_units_of_length(app, *cutoff, Length::Unit::edges);
  note_of(app, *cutoff).default_text =
      fmt::format("{0}e; with --steps N, {0}e for {1} steps, and longer for more",
                  default_cutoff_edges, reference_defaults.steps);
  CLI::Option* steps = add_integer(app, "--steps", a.steps, 0, most,
                                   "number of time steps; on noisy input, some shorter steps come "
                                   "first; 0 writes the mesh as it was read");
  note_of(app, *steps) = {.unit = "steps",
                          .default_text = fmt::format(
                              "{}; {} beyond a cut-off of {}e or with {}", quick_defaults.steps,
                              reference_defaults.steps, longest_quick_edges, reference_options)};
  CLI::Option* time_step =
      add_real(app, "--time-step", a.time_step, positive,
               "length of one time step, instead of a --cutoff for all steps together");
  time_step->excludes(cutoff)->excludes("--denoise");
  note_of(app, *time_step).unit = "mesh units^4, or mesh units^2 with --metric identity";
  note_of(app, *time_step).default_text = "computed from --cutoff";
  CLI::Option* max_move = add_length(app, "--max-move", a.max_move, Length::Unit::absolute,
                                     "move no vertex further than this from its original position");
  note_of(app, *max_move).default_text = "no limit";
}

void add_flow_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, groups::energy_and_flow);
  add_laplacian_option(app, a.flow.laplacian,
                       "discrete Laplacian of the bending energy: crouzeix-raviart removes folded "
                       "spikes best, lagrange suits smooth limits and round shapes, umbrella suits "
                       "noise on uneven triangles (see the list below)");
  CLI::Option* h0 =
      app.add_option("--h0", a.h0,
                     "spontaneous curvature H0 of the energy 1/2 integral (H - H0)^2: a number, "
                     "the name of a vertex property, or a text file with one number per vertex; "
                     "positive for a sphere that bulges outward; only with --laplacian lagrange")
          ->type_name(name_or_file_to_read);
  note_of(app, *h0).unit = "1 / mesh units";
  note_of(app, *h0).default_text = "0";
  CLI::Option* anisotropy = add_parsed_option(
      app, "--anisotropy", "X,Y,Z,FACTOR",
      "multiply the curvature kappa_1 along the direction X,Y,Z by FACTOR: the energy is 1/2 "
      "integral (FACTOR kappa_1 + kappa_2)^2. The direction is projected onto the surface without "
      "its noise; only with --laplacian lagrange",
      [&a](const std::string& text) {
        a.anisotropy = parse_reals_option("--anisotropy", text, 4, any_real);
      });
  note_of(app, *anisotropy).default_text = "none";
  add_mass_options(app, a.mass);
  app.add_option("--metric", a.metric,
                 "inner product of the flow: mass (independent of the sampling; valences with "
                 "--mass valence) or identity")
      ->check(CLI::IsMember({"mass", "identity"}))
      ->capture_default_str();
  CLI::Option* twicing = add_integer(
      app, "--twicing", a.flow.twicing, 0, 100,
      "smooth the removed part as well and add it back, N times (Tukey's twicing): bumps and the "
      "volume keep their size, and a --cutoff 1.5 times as long removes more noise");
  note_of(app, *twicing).unit = "times";
  CLI::Option* iterations =
      add_integer(app, "--newton-iterations", a.flow.newton_iterations, 1, 1000,
                  "number of inexact Newton iterations in each time step");
  note_of(app, *iterations).unit = "iterations";
  CLI::Option* tangential =
      app.add_option("--tangential", a.tangential,
                     "tangential relaxation: after each step, move vertices within the surface so "
                     "that triangles become even, and flatten spikes (relax); only in the first "
                     "steps, which remove strong noise (first); never (none); never, and let "
                     "--twicing add back tangential moves, too (keep)")
          ->check(CLI::IsMember({"relax", "first", "none", "keep"}));
  note_of(app, *tangential).default_text =
      "relax; first for a mesh with texture coordinates; none with --plain and with --laplacian "
      "umbrella";
  app.add_option("--first-stage", a.first_stage,
                 "what removes noise before edges are kept sharp: a short flow that keeps only "
                 "edges of more than 60 degrees (flow), or a guided filter of the triangles' "
                 "normals, which is better where the noise is strong (normals)")
      ->check(CLI::IsMember({"flow", "normals"}))
      ->capture_default_str();
  app.add_flag("--plain", a.plain,
               "run the scheme as published: steps are not checked, and vertices are not relaxed");
}

void add_solver_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, groups::solver_and_memory);
  add_engine_option(app, a.engine);
  app.add_option("--solver", a.flow.solver, solver_summaries())
      ->check(CLI::IsMember(solver_names()))
      ->capture_default_str();
  CLI::Option* tolerance = add_real(
      app, "--solver-tolerance", a.solver_tolerance, positive,
      "residual at which conjugate gradients stop: a larger one saves time, but leaves ripples "
      "near the cut-off if there are few steps; below 1e-4, factorizations are in double "
      "precision");
  note_of(app, *tolerance) = {
      .unit = "relative to the initial residual",
      .default_text = fmt::format(
          "{}; {} beyond a cut-off of {}e or with --steps, {}", quick_defaults.solver_tolerance,
          reference_defaults.solver_tolerance, longest_quick_edges, reference_options)};
  CLI::Option* memory =
      add_bytes(app, "--memory", a.flow.memory_limit,
                "memory that the program may use, for example 800M or 4G: --solver auto chooses a "
                "solver that fits, and the program stops before the first step if none fits");
  note_of(app, *memory).default_text = "the memory that is available";
  app.add_flag("--dry-run", a.dry_run,
               "print what would be run, and write no mesh: for one file the time and memory that "
               "it would take, for many files the command of each")
      ->configurable(false);
}

void add_feature_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, "Features to keep");
  CLI::Option* sharp =
      add_real(app, "--keep-sharp", a.keep_sharp, turning_angle,
               "keep edges sharp at which the surface turns by more than this angle");
  note_of(app, *sharp).unit = "degrees";
  note_of(app, *sharp).default_text = "none";
  CLI::Option* weights =
      app.add_option(
             "--weights", a.weights,
             "a factor for the cut-off at each vertex, from a vertex property of the mesh or from "
             "a text file with one number per vertex: 0 fixes the vertex, 1 smooths it fully")
          ->type_name(name_or_file_to_read);
  note_of(app, *weights).default_text = "1 everywhere";
  app.add_flag("--keep-volume", a.flow.keep_volume, "keep the volume of a closed mesh exactly");
  app.add_flag("--keep-area", a.flow.keep_area, "keep the area of a closed mesh exactly");
}

void add_constraint_options(CLI::App& app, SmoothArguments& a) {
  begin_group(app, "Which vertices move");
  app.add_option(
         "--boundary", a.boundary,
         "open boundaries: fixed (the boundary and the next ring of vertices do not move), "
         "position (the boundary does not move), free (the boundary moves with the "
         "surface, along its normals) or fair (the boundary is first smoothed as a curve, up "
         "to the same cut-off, except for its corners; with --cutoff auto as far as the "
         "noise explains)")
      ->check(CLI::IsMember({"fixed", "position", "free", "fair"}))
      ->capture_default_str();
  CLI::Option* fix =
      app.add_option("--fix", a.fix_file,
                     "fix the vertices whose numbers, counted from 0, are listed in this text file")
          ->type_name(file_to_read);
  note_of(app, *fix).default_text = "none";
  CLI::Option* mask =
      app.add_option("--mask", a.mask,
                     "move only the vertices of this OBJ group, object or material, or the "
                     "vertices whose PLY property of this name is not zero")
          ->type_name("NAME");
  note_of(app, *mask).default_text = "all vertices move";
}

void add_file_options(CLI::App& app, SmoothArguments& a) {
  add_input_options(app, a.reading);
  add_strict_option(app, a.strict);
  CLI::Option* checkpoint =
      app.add_option("--checkpoint", a.checkpoint,
                     "after Ctrl-C or SIGTERM, finish the current time step, write the mesh to "
                     "this file instead of OUT, and print the command that continues; a second "
                     "signal ends the program at once")
          ->type_name(file_to_write)
          ->configurable(false);  // a batch starts an interrupted file again
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
  documentation_of(app).sections.push_back({"Denoising", denoising_text()});
  documentation_of(app).examples = {
      {"ibmfair smooth scan.ply clean.ply --denoise",
       "a noisy scan: removes noise of any strength, and keeps sharp edges if there are any"},
      {"ibmfair smooth scan.ply fair.ply --cutoff 8 --twicing 1 --report fair.html",
       "a smooth surface: removes ripples shorter than 8 mean edge lengths, and shows what "
       "changed"},
      {"ibmfair smooth part.obj fair.obj --cutoff 6 --keep-sharp 30",
       "a part with edges: keeps those at which the surface turns by more than 30 degrees"},
      {"ibmfair smooth part.obj blend.obj --mask blend --max-move 0.5e",
       "a region: moves only the group `blend`, no vertex by more than half a mean edge length"},
  };
}

}  // namespace ibmfair::commands
