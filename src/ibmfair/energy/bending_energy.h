// The family of discrete isometric bending models (IBM): Wardetzky, Bergou, Harmon, Zorin,
// Grinspun, "Discrete Quadratic Curvature Energies", CAGD 24 (2007), cited as [W07].
//
//   E_b(X) = 1/2 tr(X^T L^T M^-1 L X)                                      [W07] section 2.3
//
// the discrete counterpart of 1/2 * integral of H^2 with H = kappa1 + kappa2. L is a discrete
// Laplacian, M a mass matrix (energy/mass_matrices.h), and the sum is over the inner nodes. With a
// diagonal M a member is a sum over stencils, E_b = 1/2 sum_s w_s |sum_i c_si x_i|^2, with
// coefficients c and weights w that stay constant while the mesh bends without stretching; that
// makes its Hessian under isometry, S = sum_s w_s c_s c_s^T, a constant #V x #V matrix which acts
// on each coordinate.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/energy/material_directions.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

struct LaplacianMatrices;

/// The coefficients of all stencils at one state of the mesh.
struct StencilWeights {
  Eigen::VectorXd c;  ///< laid out as `stencils().value`; the coefficients of a stencil sum to 0
  Eigen::VectorXd w;  ///< one per stencil, positive
};

/// How a member of the family is bound to a mesh.
struct EnergyOptions {
  /// false: the mass matrix is left out (M = identity), the energy then has unit length^2 and
  /// depends on the sampling ([W07] Figure 9, right). The same as `mass_matrix` "none".
  bool mass = true;
  /// #V, or empty for all: only stencils that touch a true vertex are summed. (All of them where
  /// stencils change with the state, as on the intrinsic Delaunay triangulation, or do not add up,
  /// as with a consistent mass.)
  std::vector<std::uint8_t> active = {};
  /// A name from the model's `masses`, or empty for its default.
  std::string mass_matrix = {};
  /// #V, length^2, for `weighted`: constant weights of the vertices. Empty: those of circles, which
  /// follow the state (energy/circle_weights.h).
  std::vector<double> vertex_weights = {};
  /// A direction of the material for each triangle, #F, or empty for an energy that knows none: the
  /// density is 1/2 (c kappa_1 + kappa_2)^2 in place of 1/2 H^2, [W07] (14), with the curvatures
  /// along the direction and across it. Only for members with
  /// BendingModel::takes_material_directions.
  std::vector<MaterialDirection> material_directions = {};
  /// Hinges that turn by more than this angle (radians) hardly bend; 0: all bend. Only with mass,
  /// for members with BendingModel::keeps_sharp.
  double sharp_angle = 0;
  /// H0 of 1/2 * integral of (H - H0)^2, 1/length: #V, or empty for none. Its sign is that of H,
  /// which is positive on a sphere whose triangles look outward. Only for members with
  /// BendingModel::takes_spontaneous_curvature.
  Eigen::VectorXd spontaneous_curvature = {};
  /// #V and #F, or empty for all: what belongs to this part of a mesh in several
  /// (flow/mesh_parts.h). Only its energy is summed: of a stencil at a vertex that of its centre,
  /// of a hinge half of it at either triangle. Only for members with BendingModel::knows_parts.
  std::vector<std::uint8_t> own_vertices = {}, own_triangles = {};
};

/// One member of the family on one connectivity. Evaluations reuse buffers of the object, so one
/// object serves one thread of control; it uses all threads itself, and its results do not depend
/// on their number.
class BendingEnergy {
 public:
  BendingEnergy() = default;
  BendingEnergy(const BendingEnergy&) = delete;
  BendingEnergy& operator=(const BendingEnergy&) = delete;
  virtual ~BendingEnergy() = default;

  /// E_b(X) >= 0 for X #V x 3. Dimensionless with mass, length^2 without. Infinite or NaN where a
  /// triangle that carries a stencil has lost its area.
  virtual double energy(const Points& X) = 0;

  /// E_b(X), and its exact gradient (not assuming isometry) in G, #V x 3.
  virtual double energy_and_gradient(const Points& X, Points& G) = 0;

  /// The largest 1 + cos(theta) that the last evaluation saw at a hinge: 0 where all are flat, 2
  /// where one is folded over. Infinite for members that do not look at hinges; says nothing where
  /// the energy was not finite.
  virtual double largest_turn() const { return std::numeric_limits<double>::infinity(); }

  /// Flags (#V) of the vertices of all hinges at which the last evaluation saw 1 + cos(theta) of
  /// `turn` or more, and of others around them. Empty where any hinge may be one of these; says
  /// nothing where the energy was not finite.
  virtual std::vector<std::uint8_t> near_turns(double /*turn*/) const { return {}; }

  /// The vertices of each stencil.
  virtual const Rows& stencils() const = 0;

  /// How much of E_b(X) belongs to each vertex, #V: a stencil's energy to its vertices in equal
  /// parts, unless the member knows better.
  virtual PerVertex energy_by_vertex(const Points& X);

  /// The coefficients and weights at X, from which the Hessian S is assembled (energy/hessian.h).
  /// Where no fixed stencils give S, those of a nearby member do (energy/vertex_energy.h).
  virtual void linearise(const Points& X, StencilWeights& weights) = 0;
};

/// A row of the table of members: a Laplacian and the masses that go with it.
struct BendingModel {
  std::string_view name;     ///< as the command line takes it
  std::string_view summary;  ///< one line
  std::unique_ptr<BendingEnergy> (*make)(const Topology& topology, const EnergyOptions& options);
  /// L and M as matrices; throws BadOption for a mass that does not go with the Laplacian.
  LaplacianMatrices (*matrices)(const Points& X, const Topology& topology,
                                const EnergyOptions& options);
  std::span<const std::string_view> masses;  ///< names from mass_matrices(), the default first
  bool takes_material_directions = false;    ///< knows EnergyOptions::material_directions
  bool keeps_sharp = false;                  ///< knows EnergyOptions::sharp_angle
  bool takes_spontaneous_curvature = false;  ///< knows EnergyOptions::spontaneous_curvature
  bool evens_edges = false;                  ///< its flow slides vertices within the surface
  /// Knows EnergyOptions::own_vertices: what is at a vertex depends on the vertices near it alone.
  bool knows_parts = false;

  /// The member on a mesh. Throws BadOption for options that it does not know, for masses that do
  /// not go with it and where there is not a value for every vertex or triangle; BadMesh for a
  /// spontaneous curvature on a mesh that has no two sides.
  std::unique_ptr<BendingEnergy> bind(const Topology& topology, const EnergyOptions& options) const;
};

/// All members of the family.
std::span<const BendingModel> bending_models();

/// The member of that name; throws BadOption, naming those there are.
const BendingModel& bending_model(std::string_view name);

/// E_b of the whole mesh, for one-off use.
double bending_energy(const Points& X, const Topology& topology,
                      std::string_view model = "lagrange");

}  // namespace ibmfair
