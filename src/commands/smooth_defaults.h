// The defaults of `smooth` that depend on other options.
#pragma once

namespace ibmfair::commands {

/// Without --cutoff and --time-step, `reference_steps` steps reach this cut-off, mean edge lengths.
constexpr double default_cutoff_edges = 8;

/// The time steps of the flow, and the relative residual at which conjugate gradients stop.
struct StepDefaults {
  int steps;
  double solver_tolerance;
};

/// For long cut-offs, and if an option of `reference_options` is given. Without a --cutoff, more
/// --steps smooth more; the trials of --cutoff auto continue one another; the published scheme does
/// not shorten a step that is too long. Creases, weights and an energy without mass matrix scale
/// the linear systems so badly that a large tolerance leaves regions as they were: with --weights
/// from 0.1 to 1, the volume of a hand changes by 0.4 % instead of 1.8 %. Twicing solves many more
/// systems, for which another solver is quicker, and amplifies errors: ten passes at a cut-off of
/// 26 edges end 2.4 times as far from a torus with some noises.
constexpr StepDefaults reference_defaults{16, 0.05};
constexpr const char* reference_options =
    "--twicing, --keep-sharp, --weights, --mass none, --plain, --time-step or --cutoff auto";

/// If none is given and the cut-off is at most `longest_quick_edges` mean edge lengths; beyond,
/// factorizations take most of the time, and fewer steps gain little. Over the tori, spheres and
/// scans of tools/default_table, no other numbers of steps and tolerances are both nearer to the
/// truth and quicker. The error is that of 16 steps and 0.05 (distance 1 to 2 % less, normals 0.5
/// to 1 % more), in 0.8 of the time of the whole command. Two to four steps take 0.65 to 0.81 of
/// the time, but normals of noisy spheres are 10 to 57 % worse, and parts with edges gain up to 1.8
/// times as much volume.
constexpr StepDefaults quick_defaults{8, 0.2};
constexpr double longest_quick_edges = 12;

}  // namespace ibmfair::commands
