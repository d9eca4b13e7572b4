// The tuned constants of the flow (those of the choice of its options are in
// flow/settings/choice_tuning.h): the numbers that another value could replace, and on which
// results, times or decisions depend. Each comment gives the unit ("ratio" if it has none) and the
// meaning. Each group says what its values were chosen by, and which script in tools/ prints the
// measurements again; "no script" means that the measurements were made once, when the value was
// introduced, and "not measured" that any value of this size was expected to do.
//
// Numbers that are no choice are not listed. They stand where they are used: limits of rounding
// errors, sizes of buffers, and bounds on loops that end by themselves.
#pragma once

#include <cstddef>
#include <numbers>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The guard, which checks each step before it is taken (flow/steps/). A "decrease" is the actual
/// decrease of the energy over the predicted decrease. Chosen together with `DistortionTuning` on
/// the meshes of tools/denoise_table (noisy spheres, tori, scans) and tools/paper_tables (smooth
/// shapes that change a lot); no script varies the values one by one.
struct GuardTuning {
  double least_decrease = 0.1;  ///< ratio; a step with a smaller decrease is rejected
  double good_decrease = 0.5;   ///< ratio; above, the time step may grow
  int most_halvings = 2;        ///< count; of a move, before it is given up
  int most_slowings = 3;        ///< count; of a move near uphill vertices, before it is halved
  int most_withholdings = 6;    ///< count; of vertices at foldovers, before a move is given up
  /// Energy per unknown vertex (ratio, as this energy has no unit); no step should remove more.
  /// Without this limit, noise grows into volume. Chosen by tools/step_table.
  double most_taken = 0.25;
  double first_step = 1e-4;  ///< ratio to the target; the least first time step; not measured
  /// Counts; a flow ends after `solves` + `solves_per_step` * steps linear systems: on some meshes
  /// it would take longer than a user would wait. The bounds for flows without clean-up are those
  /// of patches and of a first stage, which are worth less. Not measured.
  int solves = 200, solves_per_step = 20;
  int solves_without_clean_up = 20, solves_per_step_without_clean_up = 4;
};

/// What a step may do to the triangles (flow/steps/distortion.h). Chosen as `GuardTuning` is. With
/// roughness alone, a bunny at a cut-off of 20 edges gained 38 % of volume, with both limits 8 %,
/// as with four times the steps (no script).
struct DistortionTuning {
  double largest_roughness = 0.15;  ///< ratio to the edge length
  double largest_strain = 0.4;      ///< ratio to the edge length
};

/// The length of time steps (flow/steps/step_control.h). Chosen as `GuardTuning` is.
struct StepControlTuning {
  double cut = 1.0 / 32;               ///< ratio; of a time step that distorts too much or fails
  double shortened = 0.5;              ///< ratio; of a time step too long for a new Jacobian
  double growth = 2, fast_growth = 8;  ///< ratios; of the time step
  double little_distortion = 0.5;      ///< ratio to the limit; below, the growth is fast
  int oldest_when_damped = 4;          ///< count; steps with one Jacobian if regions are damped
  double smallest = 1e-12;             ///< ratio to the target; below, the flow ends; not measured
};

/// Regions that the flow slows down (flow/steps/local_damping.h, uphill_vertices.h,
/// time_deficit.h). Chosen on scans with needles and on noise that crumples a mesh. On five scans,
/// with two Laplacians and four cut-offs, damping with a later clean-up took 3.2 factorizations in
/// the mean instead of 6.9 (no script).
struct DampingTuning {
  double uphill_share = 0.05;         ///< ratio to the steepest increase of the energy
  double local_share = 0.02;          ///< ratio to all unknowns; with more, trouble is global
  double slower = 0.1;                ///< ratio; of moves near uphill vertices
  double heavier = 256, lighter = 4;  ///< ratios; by which damping grows and fades
  double standstill = 1e12;           ///< ratio; damping at the bound on moves; not measured
  double memory = 0.25;               ///< ratio to the total time; `memory` of TimeDeficit
};

/// Tangential relaxation (flow/steps/tangential_relaxation.h). Chosen on noisy hands and on the
/// parts with creases of tools/denoise_table, which prints their errors.
struct RelaxationTuning {
  /// The share of their area that the triangles at a vertex keep, seen along the vertex normal. A
  /// vertex can stick out only if less is left, as at foldovers and spikes: 0.7 is left of
  /// triangles that are tilted by 45 degrees.
  double little_left = 0.7;
  double more_left = 1.02;  ///< ratio to the share on a wedge; beyond, the surface is no wedge
  /// Let the triangles' unit normals at a vertex be weighted by the triangles' angles there. This
  /// is the sum of their squared components across the mean normal, over the sum along the mean
  /// normal, on a crease that turns by 80 degrees (tan^2 of half that angle). No vertex moves
  /// across such a crease, and vertices move in part across creases that turn by less. With half of
  /// this limit, folds made by noise would stay, too; with the limit for 90 degrees or more,
  /// creases would be rounded.
  double crease = 0.7;
  /// The share that is left of normals tilted by 2 degrees. Above it, no crease is looked for: a
  /// mesh of 393k vertices with creases took 5.9 s instead of 7.7 s (no script).
  double all_left = 0.9995;
  /// Radians; triangles with a smaller angle are needles. With one sweep at needles before the
  /// first step, a change in the last digit of the dinosaur's coordinates changes the result by
  /// 1e-13 of its size instead of 6e-6; with a sweep everywhere, three meshes of
  /// tools/denoise_table end with one more fold.
  double needle = radians(1);
};

/// Rims, that is, open boundaries that move (flow/steps/free_rims.h, flow/passes/rim_runs.h,
/// rim_fairing.h and restored_rims.h). Chosen on a bunny, a torus, a sphere, a block and a plane
/// with a bump, all with noise, whole or with a hole or a half cut off; `tools/denoise_table
/// --rims` prints what they leave on others.
struct RimTuning {
  /// Ratio to that at the start: the largest distance of a rim vertex from the mean of its
  /// neighbours. Without it, a scan's rim moved by 7.3 edges instead of 2.6; not varied.
  double growth = 1.1;
  /// With known noise: counts; how many cut-offs are tried on each run, from that of the surface
  /// upward, and the ratio of successive ones. A curve averages over fewer vertices than a surface:
  /// the best is 1.5 to 2 times that of the surface for the holes of a bunny, 4 times for smooth
  /// outlines.
  int tried = 7;
  double longer = std::numbers::sqrt2;
  int steps = 4;           ///< count; of backward Euler along a curve; not measured
  int normal_rings = 4;    ///< count; over which normals at a rim are averaged; not measured
  double least_waves = 3;  ///< count; of the cut-off on a run, so that holes keep their size
  /// Corners: count, vertices fitted on either side; radians, the least turn of a corner; ratio of
  /// that turn to the turn over twice as many vertices, at least. With these, all corners of a
  /// square of 160 vertices with noise of 0.4 edges are found, and no others (no script).
  Index fitted = 6;
  double corner = radians(60), lasting = 0.8;
  /// What is given back to rims (flow/passes/restored_rims.h): ratio to the variance of the noise,
  /// the least sum of squares that is gained, which noise reaches once in 70 times where nothing is
  /// to be given back; and ratio to the number of vertices, a wavelength that leaves a constant.
  double clear_gain = 4, constant = 4;
};

/// The flow to its limit (flow/steps/stationary_flow.h). Chosen on caps of spheres and on the holes
/// of four scans. tools/fill_table prints errors and times; no script varies the values.
struct StationaryTuning {
  double leap = 256;        ///< ratio; by which the time step grows and shrinks
  double longest_move = 2;  ///< ratio to the edge length; along the normal in one step
  int most_attempts = 12;   ///< count; at a step
  int most_steps = 10;      ///< count; with one Jacobian
  std::size_t pairs = 8;    ///< count; curvature pairs of limited-memory BFGS
};

/// The first stage (flow/first_stage.h). Chosen on the parts with creases of tools/denoise_table.
struct FirstStageTuning {
  double angle = std::numbers::pi / 3;  ///< radians; the sharp angle
  int steps = 4;                        ///< count
  double most_time = 0.25;              ///< ratio to the time of the flow
  /// The cut-off (mean edge lengths) if hinges turn by `noisy_turn` (radians) or more on the mean,
  /// as with noise of a fifth of the edge length.
  double edges = 2.8, noisy_turn = radians(25);
  /// The stage by normals: sweeps (counts) of the filter and of the vertices' fit, and the
  /// difference of guides (distance of unit vectors) that counts as unlike. Chosen on three
  /// benchmark meshes with noise of 0.4 to 0.6 edges, from 1 to 20 sweeps and differences of 0.25
  /// to 0.5; results differ by a few per cent between 2 and 4 sweeps (no script).
  int normal_sweeps = 2, vertex_sweeps = 10;
  double unlike = 0.35;
};

/// Short cut-offs (flow/short_cutoff.h), in mean edge lengths. The shortest cut-off that removes
/// any noise is about 2; tests/flow/short_cutoff_test.cpp bounds the moves at shorter ones.
struct ShortCutoffTuning {
  double enough = 2;    ///< from here on, relaxation is full
  double clean_up = 1;  ///< from here on, there is a clean-up
  /// RelaxationTuning::crease (ratio) for shorter cut-offs than `enough`: no vertex moves across a
  /// crease that turns by 25 degrees or more, and none leaves a corner at which one face is large.
  double crease = 0.05;
};

/// The clean-up after the time steps (flow/passes/clean_up.h, unfolding.h). Chosen on scans with
/// needles and folds (no script); tools/denoise_table counts the triangles that stay flipped.
struct CleanUpTuning {
  double little_deficit = 0.1;  ///< ratio to the time reached; smaller ones are ignored
  int rings_around = 2;         ///< count; of vertices that damped regions have slowed down as well
  /// Radians; hinges with smaller dihedral angles may be folds.
  double fold = std::numbers::pi / 3;
  std::size_t largest_fold = 200;  ///< count; vertices of a folded patch; larger patches are noise
  /// The least flatness (ratio, 1 for a plane) around a folded patch. It is 0.9 to 1 around folded
  /// patches made by noise, 0.6 around claws of a scan that are inside out, and 0.5 around folds of
  /// 60 degrees. If the energy does not measure curvature, a lower energy does not prove a better
  /// surface, and more is asked for.
  double flat = 0.6, flat_without_curvature = 0.88;
  int sweeps = 40;  ///< count; that even out a patch of a few rings; not measured
};

/// Residual spikes (flow/passes/residual_spikes.h). Chosen on the parts with creases of
/// tools/denoise_table: the fandisk ends at 0.0545 edges from the truth instead of 0.0549, eleven
/// other meshes as before or nearer by up to 2 %.
struct SpikeTuning {
  std::size_t largest = 19;  ///< count; vertices of a spike: a vertex with two rings
  double sharp_share = 0.5;  ///< ratio to the sharp angle; above, hinges are kept in part
  double flat = 0.9;         ///< ratio; the least flatness around a spike, as in CleanUpTuning
};

/// Outliers (flow/passes/outliers.h). No vertex of 47 shapes without noise is beyond all limits;
/// with 6 instead of 8 beside the surface, the tip of a horn is. tools/denoise_table --kinds prints
/// what is left of outliers of several sizes.
struct OutlierTuning {
  double beside_neighbours = 1;  ///< ratio to the neighbours' mean distance from the prediction
  double beside_mesh = 6;        ///< ratio; of the first one to its median over the mesh
  double beside_surface = 8;   ///< ratio to the neighbours' median distance from their predictions
  double sound_at_rims = 0.5;  ///< ratio to the limit of the first two; once all others have moved
  /// Count; single triangles stick out of the rims of depth images, also where these have no noise.
  static constexpr std::size_t least_neighbours = 3;
  /// Count; a vertex with more neighbours is the tip of a cone of long triangles. Not measured.
  static constexpr std::size_t most_neighbours = 12;
  int passes = 8;   ///< count; each finds outliers that others hid; not measured
  int sweeps = 20;  ///< count; of Gauss and Seidel's method for their positions; not measured
};

/// Twicing (flow/passes/twicing.h). Beyond the cut-off, n passes leave n times the share of a
/// ripple that one pass leaves, and with few steps that share is large. With eight steps instead of
/// four, the meshes of tools/denoise_table end 1 to 5 % nearer to the truth if the residual is a
/// move, but not if it is a height.
struct TwicingTuning {
  int steps_of_moves = 8, steps_of_heights = 4;  ///< counts; backward Euler steps of each pass
  /// Relative residual; of solves, as no later step removes it. With 0.001 a noisy sphere of 1.3M
  /// triangles takes a sixth more time, and ends no nearer to the truth (no script).
  double tolerance = 1e-2;
};

/// The renumbering of a mesh for the flow (flow/passes/local_mesh.h). Chosen on noisy spheres of
/// 41k and 655k vertices with shuffled vertices and triangles. To a cut-off of 4 edges, the flow of
/// the large one takes 3.0 s in order, 6.2 s shuffled, and 3.7 s shuffled with renumbering (no
/// script).
struct RenumberingTuning {
  Index fits_the_cache = 30000;  ///< count; meshes with fewer vertices are not renumbered
  /// Difference of vertex numbers; vertices that differ by at most this are close in memory, as
  /// lines of scans are not much longer.
  Index near_in_memory = 2048;
  /// Ratio of the edges that are longer in memory; above, the mesh is renumbered. Of an ordered
  /// mesh hardly any edge is, of a mesh in random order nine in ten. Of a subdivided mesh up to
  /// three in four are, but in an order that the processor can prefetch: renumbering would save a
  /// tenth of the time, at the price of a second topology in memory.
  double most_far = 0.8;
};

/// Thin walls (flow/settings/thin_walls.h, flow/passes/restored_walls.h). Chosen on plates, trays,
/// rings, shells, rods and leaves of 0.01 to 2 edges, with and without noise
/// (tests/program/thin_walls_test.cpp). 75 to 100 % of their area have walls thinner than two
/// edges; of a coarse bunny with thin ears it is 6 %, of other models at most 0.7 %.
struct ThinWallTuning {
  /// The thickest wall: mean edge lengths, and ratios to the cut-off and to the root of the area
  /// (0.56 for a ball, 0.12 for a plate five times as wide as thick).
  double edges = 2, of_cutoff = 1, of_size = 0.15;
  double share = 0.25;  ///< ratio; of the area of a component that is a thin wall
  /// Ratio of the length of the sum of the normals around a triangle to the sum of their lengths,
  /// at least. It is 0.5 on rods and 0.65 to 1 on other thin parts, and at most 0.33 where noise of
  /// half an edge or more has crumpled a sphere so that its sheets seem close together.
  double coherence = 0.4;
  /// A rim is where a path over the surface leads from one side of the wall to the other that is at
  /// most this long: ratio to the thickness, plus ratio to the edge length.
  double path = 1.3, beyond = 0.9;
  int most_seen = 1000;       ///< count; neighbours that are looked at for one path; not measured
  double share_around = 0.5;  ///< ratio; of the area around a triangle whose wall counts
  Index sample = 4'000;       ///< count; triangles that tell whether a large mesh has thin walls
  int sweeps = 6;             ///< count; of averages over one ring of the change in thickness
  int corrections = 8;        ///< count; one leaves a few hundredths of a change that varies slowly
};

/// Lines at which sheets meet (flow/passes/meeting_lines.h). Chosen on two half balls of voxels.
struct MeetingLineTuning {
  /// Ratio of the cut-off of the lines to that of the sheets. A line has fewer vertices within a
  /// wavelength than a sheet, over which noise could average out.
  double of_cutoff = 1.5;
};

/// The choice of the solver (flow/linear_system/). Seconds are those of one core of a machine of
/// 2023; only their ratios matter. tools/solver_table prints the measurements.
struct SolverTuning {
  // Factorizations. n is the number of unknowns on a surface, which has small separators.
  // tools/ordering_table prints entries and operations. The bytes were measured on tori of 41 and
  // 164 thousand vertices.
  double factor_entries = 9;        ///< entries of the triangular factor over n log2 n
  double factor_flops = 250;        ///< operations over n^1.5
  double bytes_per_unknown = 1630;  ///< bytes; of the analysis and the assembled matrix
  double bytes_per_entry = 8.5;     ///< bytes; of the triangular factor and its workspace, float64
  /// Iterations (IterationForecast::of_cutoff) for each factorization of a guarded flow, and the
  /// most factorizations. Their number grows with the cut-off: the more of the noise is removed,
  /// the more the mesh differs from the one that the Jacobian was built on.
  double iterations_per_factorization = 15, most_factorizations = 6;
  struct Factorization {
    /// Seconds per unknown: the fill-reducing ordering, which uses all cores, and the symbolic
    /// factorization, which uses one. Seconds are those on two cores, because the choice must not
    /// depend on the number of cores.
    double analysis;
    double flop;               ///< seconds per operation
    double entry;              ///< seconds per entry of the triangular factor, read twice per solve
    double library_bytes = 0;  ///< of libraries that are loaded
  };
  Factorization multifrontal = {2.2e-6, 1 / 52e9, 8 / 16e9};
  Factorization cholmod = {2.2e-6, 1 / 16e9, 8 / 3.2e9, 4e6};
  /// Largest relative residual of a solve in float32. One step of iterative refinement would leave
  /// its square. Not measured.
  double float32_residual = 1e-3;
  double float32_tolerance = 1e-4;  ///< relative residual; below, float64 is used; not measured

  // Conjugate gradients. The bytes were measured on tori of 41 and 164 thousand vertices with both
  // Laplacians, the counts on tori with and without noise and on models.
  double row = 1.5e-8;                              ///< seconds per row and iteration
  double bytes_per_place = 8, bytes_per_row = 330;  ///< a place is a vertex in a stencil
  double iterations = 3.2;  ///< iterations over an estimate of the root of the condition number
  double along = 0.45;      ///< ratio; iterations along the previous step to those from zero
  double unlike_steps = 3;  ///< count; first steps, which remove noise and gain nothing
  double by_noise = 1e3;    ///< ratio to the median of diag(J) / D; beyond, needles are the cause
  double per_needle_digit = 40;   ///< iterations per digit beyond `by_noise`
  Index sampled_unknowns = 4000;  ///< count; enough for an estimate; not measured
  double most_iterations = 1000;  ///< count; at the default tolerance; not measured

  // The choice between the two.
  /// Ratio; of the predicted seconds of backends without factorization. If the prediction was too
  /// low, a backend with factorization soon takes over; if it was too high and the backend was not
  /// chosen, nothing would correct the choice. Chosen by tools/solver_table --flows.
  double doubt = 0.6;
  /// Ratio to the rival's time for all remaining solves: time by which the solves may exceed it.
  /// With needles, the first solves take the longest. A diplodocus is smoothed 10 to 20 % faster
  /// with it, up to 2 edges or, by the Lagrange energy, up to 4 (tools/solver_table --flows).
  double most_grace = 0.05;
  int patience = 8;  ///< count; failed factorizations before conjugate gradients; not measured
};

struct FlowTuning {
  GuardTuning guard;
  DistortionTuning distortion;
  StepControlTuning step_control;
  DampingTuning damping;
  RelaxationTuning relaxation;
  RimTuning rims;
  StationaryTuning stationary;
  FirstStageTuning first_stage;
  ShortCutoffTuning short_cutoff;
  CleanUpTuning clean_up;
  SpikeTuning spikes;
  OutlierTuning outliers;
  TwicingTuning twicing;
  RenumberingTuning renumbering;
  ThinWallTuning thin_walls;
  MeetingLineTuning meeting_lines;
  SolverTuning solver;
};

inline constexpr FlowTuning tuning;

}  // namespace ibmfair
