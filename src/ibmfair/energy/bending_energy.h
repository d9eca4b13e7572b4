// The family of discrete isometric bending models (IBM): Wardetzky, Bergou, Harmon, Zorin,
// Grinspun, "Discrete Quadratic Curvature Energies", CAGD 24 (2007), cited as [W07].
//
//   E_b(X) = 1/2 tr(X^T L^T M^-1 L X)                                      [W07] section 2.3
//
// the discrete counterpart of 1/2 * integral of H^2 with H = kappa1 + kappa2. L is a discrete
// Laplacian, M a mass matrix (energy/mass_matrices.h), and the sum runs over the inner nodes. A
// stencil is a small set of vertices with one coefficient each. If M is diagonal, the energy of a
// member is a sum over stencils, E_b = 1/2 sum_s w_s |sum_i c_si x_i|^2. Its coefficients c and
// weights w stay constant while the mesh bends without stretching. The Hessian under isometry is
// therefore a constant #V x #V matrix, S = sum_s w_s c_s c_s^T, which acts on each coordinate.
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
  /// One per entry of `stencils().value`; the coefficients of a stencil sum to 0.
  Eigen::VectorXd c;
  Eigen::VectorXd w;  ///< one per stencil, positive
};

/// How a member of the family is bound to a mesh.
struct EnergyOptions {
  /// false: the mass matrix is left out (M = identity). The energy then has unit length^2 and
  /// depends on the sampling ([W07] Figure 9, right). This is equivalent to `mass_matrix` "none".
  bool mass = true;
  /// #V, or empty for all: only stencils that contain a vertex marked true are summed. The option
  /// is ignored if the stencils change with the state (intrinsic Delaunay triangulation) or if the
  /// energy is not a sum over stencils (consistent mass): all stencils are then summed.
  std::vector<std::uint8_t> active = {};
  /// A name from the model's `masses`, or empty for the model's default.
  std::string mass_matrix = {};
  /// #V, length^2, for the model `weighted`: constant weights of the vertices. If empty, the
  /// weights are those of circles about the vertices and change with the positions
  /// (energy/circle_weights.h).
  std::vector<double> vertex_weights = {};
  /// A direction of the material for each triangle, #F, or empty for an isotropic energy. The
  /// energy density is 1/2 (c kappa_1 + kappa_2)^2 in place of 1/2 H^2, [W07] (14), where kappa_1
  /// is the curvature along the direction and kappa_2 the curvature across it. Only for members
  /// with BendingModel::takes_material_directions.
  std::vector<MaterialDirection> material_directions = {};
  /// A hinge is an interior edge with its two triangles. Hinges whose triangles turn by more than
  /// this angle (radians) are hardly bent by the energy; 0: all hinges bend freely. Only with a
  /// mass matrix and for members with BendingModel::keeps_sharp.
  double sharp_angle = 0;
  /// The spontaneous curvature H0 in 1/2 * integral of (H - H0)^2, 1/length: #V, or empty for none.
  /// The sign convention is that of H, which is positive on a sphere whose triangles are oriented
  /// outward. Only for members with BendingModel::takes_spontaneous_curvature.
  Eigen::VectorXd spontaneous_curvature = {};
  /// #V and #F, or empty for all: the vertices and triangles of one part of the mesh, whose energy
  /// alone is summed. The energies of parts that have every vertex and triangle once add up to that
  /// of the mesh: the stencil of a vertex counts if its centre belongs to the part, and half the
  /// energy of a hinge counts for each of its two triangles that belongs to the part. Only for
  /// members with BendingModel::knows_parts.
  std::vector<std::uint8_t> own_vertices = {}, own_triangles = {};
};

/// One member of the family on one connectivity. Evaluations reuse buffers of the object, so an
/// object must not be used by two threads at the same time. An evaluation itself runs on all
/// threads, and its results do not depend on their number.
class BendingEnergy {
 public:
  BendingEnergy() = default;
  BendingEnergy(const BendingEnergy&) = delete;
  BendingEnergy& operator=(const BendingEnergy&) = delete;
  virtual ~BendingEnergy() = default;

  /// E_b(X) >= 0 for X #V x 3. Dimensionless with a mass matrix, length^2 without. Infinite or NaN
  /// if a triangle that carries a stencil has no area.
  virtual double energy(const Points& X) = 0;

  /// E_b(X), and its exact gradient (not assuming isometry) in G, #V x 3.
  virtual double energy_and_gradient(const Points& X, Points& G) = 0;

  /// The largest 1 + cos(theta) over all hinges in the last evaluation, where theta is the dihedral
  /// angle: 0 if all hinges are flat, 2 if a hinge is folded over. Infinite for members whose
  /// stencils are not hinges. Undefined if the last energy was not finite.
  virtual double max_dihedral_turn() const { return std::numeric_limits<double>::infinity(); }

  /// Flags (#V) the vertices of all hinges with 1 + cos(theta) >= `turn` in the last evaluation;
  /// other vertices near such hinges may be flagged as well. Empty if the member cannot tell, so
  /// that any hinge may qualify. Undefined if the last energy was not finite.
  virtual std::vector<std::uint8_t> near_turns(double /*turn*/) const { return {}; }

  /// The vertices of each stencil.
  virtual const CompressedRows& stencils() const = 0;

  /// The part of E_b(X) that belongs to each vertex, #V: by default, the energy of a stencil is
  /// divided equally among its vertices; a member may override this with a more exact split.
  virtual PerVertex energy_by_vertex(const Points& X);

  /// The coefficients and weights at X, from which the Hessian S is assembled (energy/hessian.h).
  /// If S is not a sum over fixed stencils, the coefficients and weights of a similar member are
  /// returned instead (energy/vertex_energy.h).
  virtual void linearise(const Points& X, StencilWeights& weights) = 0;
};

/// A row of the table of members: a Laplacian and the mass matrices that can be combined with it.
struct BendingModel {
  std::string_view name;     ///< the name used on the command line
  std::string_view summary;  ///< one line
  std::unique_ptr<BendingEnergy> (*make)(const Topology& topology, const EnergyOptions& options);
  /// L and M as matrices; throws BadOption for a mass matrix that cannot be combined with the
  /// Laplacian.
  LaplacianMatrices (*matrices)(const Points& X, const Topology& topology,
                                const EnergyOptions& options);
  std::span<const std::string_view> masses;  ///< names from mass_matrices(), the default first
  bool takes_material_directions = false;    ///< supports EnergyOptions::material_directions
  bool keeps_sharp = false;                  ///< supports EnergyOptions::sharp_angle
  bool takes_spontaneous_curvature = false;  ///< supports EnergyOptions::spontaneous_curvature
  bool evens_edges = false;  ///< its gradient also has a part within the surface, even on planes
  /// Supports EnergyOptions::own_vertices: the energy at a vertex depends only on nearby vertices.
  bool knows_parts = false;

  /// The member on a mesh. Throws BadOption for options that the member does not support, for mass
  /// matrices that cannot be combined with it, and for options that do not have one value for every
  /// vertex or triangle. Throws BadMesh for a spontaneous curvature on a mesh that is not
  /// orientable.
  std::unique_ptr<BendingEnergy> create(const Topology& topology,
                                        const EnergyOptions& options) const;
};

/// All members of the family.
std::span<const BendingModel> bending_models();

/// The member with this name. Throws BadOption for an unknown name; the message lists the known
/// names.
const BendingModel& bending_model(std::string_view name);

/// E_b of the whole mesh, for a single evaluation.
double bending_energy(const Points& X, const Topology& topology,
                      std::string_view model = "lagrange");

}  // namespace ibmfair
