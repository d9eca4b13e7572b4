// The tuned constants of what is chosen from the noise of a mesh: cut-off, creases, Laplacian. The
// comments are like those of flow/tuning.h.
#pragma once

#include <cstddef>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/types.h"

namespace ibmfair {

/// The choice of the cut-off (flow/settings/cutoff_choice.h, cutoff_trials.h, sample_of_mesh.h).
/// Risks are in variances of the noise. Chosen on noisy tori, spheres, scans and parts, where the
/// chosen cut-off is close to the best one; tools/denoise_table prints the errors of `--denoise`.
struct CutoffTuning {
  double shortest = 2;        ///< mean edge lengths; the first cut-off
  double clear_rise = 0.03;   ///< risk; trials end that far above the least risk
  double small_gain = 0.002;  ///< risk; trials end if a doubled cut-off changes it less
  double many_more = 1.5;     ///< ratio to `sample`; meshes with more free vertices are sampled
  Index sample = 50'000;      ///< count; vertices of the sample
  double least_inner = 0.25;  ///< ratio to `sample`; a sample must have more inner vertices
  /// Counts; patches of the sample (more would cover more regions, but have longer rims), and rings
  /// that a rim affects at the longest cut-off. On a noisy sphere of 164k vertices the choice by a
  /// sample took 3.6 s instead of 52 s, and gave 19.9 edges instead of 23.1 (no script).
  std::size_t patches = 2;
  int felt_rings = 32;
  /// Count; backward Euler steps from one cut-off to the next. The choice takes 0.33 to 0.55 of the
  /// time of flows that all begin at the start, and chooses the same cut-offs to 2 % (no script).
  int leg_steps = 4;
  double law_edges = 8;    ///< mean edge lengths; from here on, the trace may follow Weyl's law
  double near_law = 0.15;  ///< ratio; the largest deviation of a trace that follows Weyl's law
  /// Count; terms of the polynomial up to which a linear flow is computed by it, and beyond which
  /// by linear systems (flow/settings/linear_smoother.h).
  std::size_t most_terms = 110;
  /// Relative residual; of solves in linearised trials. With 0.01, what is left of the moves where
  /// triangles are evened out hides noise of 0.03 edges (tests/slow/cutoff_choice_test.cpp).
  double tolerance = 1e-3;
  std::size_t noise_trial = 1;  ///< index; this trial measures noise, and hardly changes the shape
  /// The noise that is added to estimate risks where creases are kept: ratio to the noise, and at
  /// least ratio to the mean edge length; not measured.
  double added_noise = 0.3, least_added = 1e-5;
};

/// The kind of the noise (flow/settings/noise_kind.h, level_steps.h, steps_choice.h). The limits
/// are about midway between the figures of the kinds on the meshes of `tools/denoise_table --pairs`
/// and `--correlated`, noisy and not, all of which were seen when the limits were chosen.
struct NoiseTuning {
  /// Ratio; the least evenness of noise. That of independent noise is 0.57 or more in the first
  /// three bands, that of a depth camera 0.54. The least of a shape's three bands is at most 0.3 on
  /// fine meshes, and up to 0.49 on meshes of 500 to 4000 vertices, whose details are not longer
  /// than some edges; round shapes with facets are an exception (see `tails`).
  double even = 0.5;
  /// Ratio; the largest evenness of noise. It is at most 0.86 for noise, and 0.91 and more for
  /// threads, waves and studs that cover the surface in rows.
  double too_even = 0.9;
  /// Noise by the angles of hinges (hinge_noise.h). Ratio; by which its quantiles may differ: at
  /// most 1.3 for noise on coarse parts of 100 vertices, 1.06 on larger ones, and 1.5 or more for
  /// most noise that is only in some places. Ratio to the standard deviation by the median of what
  /// a cut-off removes, from which on it counts: 0.3 to 0.77 for coarse parts, 0.9 and more for
  /// most other noisy meshes. Ratio to the same of the white part of the first two bands, at most:
  /// 0 to 0.86 for coarse parts, and 1 for noise that is only in some places. Mean edge lengths;
  /// from here on angles do not grow as the noise does, and tell too little.
  double same_by_hinges = 1.35, by_hinges = 0.8, white_share = 0.9, largest_by_hinges = 0.25;
  /// Mean edge lengths; the least standard deviation of noise that is correlated. Not measured.
  double least = 0.01;
  /// How far local means of a band reach for its evenness: ratio to the cut-off, and at least
  /// edges.
  double reach = 1.5, least_reach = 4;
  /// Ratios; the least and the largest standard deviation by the mean square, to that by the
  /// median, of correlated noise. It is 1.03 to 1.14 for the noise of depth cameras, 0.85 to 0.89
  /// for the facets of round shapes that were subdivided, and 1.2 or more for details of a shape.
  double tails = 0.92, long_tails = 1.18;
  /// Ratio of the standard deviation by the mean square to that by the median, of all that the
  /// second cut-off removes; from here on there are outliers. It is at most 1.16 for normal noise,
  /// and 1.47 and more for impulsive noise.
  double outliers = 1.3;
  /// Ratio of the standard deviation by the mean square to that by the median; noise with light
  /// tails has less. It is 0.99 or more for normal noise, and at most 0.94 for uniform noise.
  double light_tails = 0.95;
  /// Ratio; the most by which the standard deviation by the mean square may grow from the first
  /// band to the second if there are outliers, as they are independent. It is 1.04 for impulsive
  /// noise, and 1.41 for the edges of an icosahedron without noise, which else has the figures of
  /// outliers.
  double same = 1.2;
  /// Ratio; of the standard deviation in the third band to that in the first, at least, if the
  /// noise is correlated. It is 1.0 to 1.4 for independent noise on all but coarse meshes, 2.2 and
  /// more for noise averaged over one ring, and 2.7 for the noise of depth cameras.
  double growth = 2;
  /// Ratio; the same from one of two later bands to the next. It is 1.8 and more for noise that is
  /// averaged twice or more over one ring.
  double later_growth = 1.5;
  /// Ratio; of the standard deviation in the fourth band to that in the third, at least. It is 1.1
  /// and more for noise, and 0.3 to 0.5 for a coarse polyhedron that was subdivided twice.
  double fall = 0.8;
  /// Ratio; of the standard deviation in a band to that in the first, at least, for more than white
  /// noise to be in it.
  double mixed_growth = 1.4;
  /// Ratios; of what is not white in a band to that in the band before, by the mean square, and by
  /// the geometric mean of that and the same by the median. More than either is details, or noise
  /// that is correlated far; if it is noise, the next band has at most `level`, by the mean square.
  /// Into the band of 5.7 edges they are 2.85 and more, or 3.1 and more, for details of models, at
  /// most 2.83 and 2.95 for noise that is averaged once or twice, and 3 and more if it is averaged
  /// four times; into the next one, 2.2 and more for details, and 1.2 to 2.0 for noise.
  double steep = 2.85, steep_by_both = 3.03, level = 2.05;
  /// The product of both by the mean square, which is 7.5 for details of a part with white noise,
  /// and at most 7 for noise (7.9 for noise of 0.1 on one scan).
  double steep_twice = 7.2;
  /// Ratios; the evenness of white noise, and the least one of what a band has beyond it, for that
  /// to be noise as well. It is 0.5 and more for correlated noise as strong as the white noise, on
  /// scans and shapes without creases, and at most 0.47 for their details.
  double evenness_of_white = 0.75, even_rest = 0.48;
  /// Ratio; of the weight of the last band to that of the others in the fit of a mixture. Details
  /// of the shape enlarge that band most.
  double last_weight = 0.3;
  /// Logarithm of a ratio; bands that differ more from those of correlated noise alone may be of a
  /// mixture. It is 0.08 to 0.12 without white noise, and 0.17 to 0.28 with a third or half as much
  /// of it.
  double good_fit = 0.14;
  /// Ratio; of the variance of a mixture that is not white, at least. Round shapes have that little
  /// of even detail.
  double correlated_share = 0.1;
  /// The sum of squares (ratios) by which a mixture of noise over more rings must fit better. It is
  /// 0.013 and more for the true number of rings on spheres and scans.
  double better_fit = 0.012;
  /// Noise that shows only in longer bands: the stronger it is, the more of it must be in shorter
  /// bands. Per mean edge length of its standard deviation: the ratio of what is there to what the
  /// model makes there. It is 1.49 or more on 84 of 87 meshes with noise of 0.1 to 0.5, 0 for flat
  /// facets, and 0.6 to 1.2 for bumps that cover a mesh. Logarithm of a ratio: the most by which
  /// bands may differ from the model. It is at most 0.48 for noise, and 0.55 to 1.1 for most bumps.
  /// Ratio: of what the model makes in shorter bands, at most so much is there. It is 1.8 for the
  /// slices of a scanner, up to 7.5 for noise on parts (9 on one), and 7.8 and more for details of
  /// parts with white noise that is weak, along one axis, or stronger in some places.
  double shows = 1.45, poor_fit = 0.5, too_much_before = 7.6;
  /// As CutoffTuning::sample and felt_rings, if the noise is correlated. A scan of 86k vertices
  /// takes 3.8 s instead of 6.3 s, and ends with a median angle between faces of 0.69 degrees
  /// instead of 0.68 (5.8 before).
  Index sample = 24'000;
  int felt_rings = 24;
  /// Ratio; CutoffTrial::slope_weight if the noise is correlated. Hardly any flow removes its long
  /// waves, and what counts is that the faces are smooth. With 0, the depth camera's scan ends at
  /// 7.1 degrees instead of 6.8, and fifteen shapes with noise averaged over one to four rings are
  /// about as good.
  double slopes = 2;
  /// Ratio; of the standard deviation by the mean square in the second band to that in the first,
  /// for details of a shape. It is 1.3 to 1.9 on models without noise, and 1.0 to 1.1 for noise of
  /// any distribution on smooth shapes.
  double growth_of_details = 1.45;
  /// Steps. Mean edge lengths: the least step (smaller ones are like independent noise), and how
  /// far off a level a coordinate may be. Count: levels on an axis, at least. Not measured.
  double least_step = 0.3, off_level = 1e-4, least_levels = 8;
  /// The errors of steps (flow/settings/steps_choice.h). Steps: the largest error that is likely;
  /// ratio of the vertices: at most so many may move further. All but one vertex in a thousand of
  /// voxel balls, ellipsoids and tori move by at most 1.2 steps, of voxel boxes, cylinders and
  /// slabs by 2.3 or more if their creases are not kept. Radians: the sharp angle for creases.
  double largest_error = 1.3, beyond_error = 0.001, creases_of_steps = radians(20);
  /// Ratios: of the normals' squared components along the axes with levels, and of bent hinges
  /// (radians), at least. A cube of 10 x 10 squares on each side has 7 % of bent hinges. Not
  /// measured.
  double along_axes = 0.9, bent_hinges = 0.1, bent = radians(10);
  /// Mean edge lengths; less than this is not taken for noise. The estimate for shapes without
  /// noise is up to 0.047 (originals of benchmarks, models), and 0.06 and more with noise of 0.05.
  double negligible = 0.05;
  /// Mean edge lengths; the same for noise that looks white. One original has 0.022.
  double negligible_white = 0.03;
  /// Ratios; the least evenness of white noise, and the most by which it grows from the first band
  /// to the second. It is even by 0.65 to 0.85, and grows by 0.8 to 1.2 times, on smooth shapes
  /// with noise of 0.05; shapes without noise grow by 1.5 times or more, or are less even.
  double white_even = 0.6, white_growth = 1.3;
  /// Ratio: more flat hinges than this are not found in noisy meshes; radians: the most that a flat
  /// hinge turns by. Parts with planes have 0.34 or more, noisy meshes at most 0.001, or 0.06 if
  /// half of the vertices are outliers. Ratio to the standard deviation by independent noise: the
  /// same, of which noisy meshes have 0.08 to 0.13, and coarse cubes, brackets, cylinders and cones
  /// 0.25 or more, with noise of up to a quarter of what their edges look like.
  double flat_hinges = 0.25, flat = radians(0.01), unlikely_bend = 0.1;
  /// Ratio; more vertices than this have no flat hinge if noise is only in some places. It is 0.38
  /// and more for noise along one axis, or on one half, of a benchmark part, and at most 0.23 for
  /// coarse parts, whose details are as short as noise.
  double bent_vertices = 0.3;
  /// Rounded coordinates: mean edge lengths, the largest step; ratio of the levels between the
  /// first and the last that are used, at least; ratio of the normals' squared components along
  /// their axis, at least, which leaves out the rows and columns of a grid. Not measured.
  double largest_step = 1.5, levels_used = 0.5, along_rounded = 0.5;
};

/// The choice of creases (flow/settings/crease_choice.h). Risks are in variances of the noise,
/// "shares" are of the risk without creases. Chosen on the pairs of `tools/denoise_table --pairs`
/// and shown on the meshes of `tools/denoise_table`.
struct CreaseTuning {
  /// Degrees; sharp angles to try, the sharper or the blunter ones after the first.
  double first_angle = 14, sharper_angles[2] = {20, 28}, blunter_angles[2] = {10, 7};
  double clear_gain = 0.006;  ///< risk; the least decrease for another angle to be taken
  /// Creases are kept below this share (ratio). On parts with creases it is at most 0.74, with
  /// noise of 0.2 to 0.7 edges; on scans it is 0.99 or more.
  double clear_share = 0.85;
  double some_share = 0.9;  ///< other angles are tried below this share (ratio)
  double hopeless = 1.25;   ///< ratio; slopes do not count where distances are above this share
  /// Ratio; the weight of the risk of slopes beside that of distances. With slopes, the creases of
  /// the pair cnr_eight are kept (Ea 4.0 instead of 6.0 degrees), and those of polyhedra of 80
  /// faces with noise of 0.1; smooth shapes are further from having any: 1.4 to 5 times as much
  /// risk with creases as without, 1.0 to 2.9 times by distances alone.
  double slopes = 2;
  /// Risk: the least rise from half the first cut-off to it, with the bluntest angle, if the noise
  /// is a mixture. It is 0.006 and more for mixtures with half as much correlated noise as white
  /// noise, on smooth shapes, 0.03 and more with as much of it, and at most 0.002 for white noise.
  double clear_rise = 0.004;
  double chance = 2;            ///< risk; differences over the root of the number of vertices
  double first_cutoff = 5.657;  ///< mean edge lengths; the first cut-off to try
  double least_risk = 0.01;     ///< risk; below, no creases are looked for
};

/// The choice of a Laplacian where no creases are kept (flow/settings/laplacian_choice.h). Risks
/// are in variances of the noise. Of 48 noisy tori one lies above `chance`, and of 12 noisy
/// spheres, of which the linear elements leave 0.2 to 0.4 of the error of the normals, ten.
struct LaplacianTuning {
  double first_cutoff = 1.35;  ///< ratio to the cut-off of the first Laplacian
  double chance = 0.3;         ///< risk; differences over the root of the number of vertices
  double hopeless = 0.05;      ///< risk; no cut-off makes up for so much at the first one
  /// Risk; the same for the first cut-off with flows on the same noise as those of the first
  /// Laplacian. On 331 noisy meshes the first cut-off of a Laplacian that was then chosen left at
  /// most 0.006 more, and in 38 of 54 other searches more than this.
  double worse_start = 0.01;
  /// As CutoffTuning::sample and felt_rings. Which Laplacian is better depends on the triangles,
  /// which are much the same all over a mesh. The Laplacians chosen for three scans of 35k vertices
  /// and three polyhedra of 41k are the same as with all vertices, their cut-offs within 4 %, and
  /// the choice takes 0.55 to 0.65 of the time.
  Index sample = 16'000;
  int felt_rings = 16;
};

/// Components of different size (flow/settings/component_scales.h). Not measured.
struct ComponentTuning {
  double alike = 0.7;  ///< ratio of mean edge lengths
  double share = 0.1;  ///< ratio; of the vertices
};

struct ChoiceTuning {
  CutoffTuning cutoff;
  NoiseTuning noise;
  CreaseTuning creases;
  LaplacianTuning laplacian;
  ComponentTuning components;
};

inline constexpr ChoiceTuning choice_tuning;

}  // namespace ibmfair
