// A thin plate: its material, its fixed vertices, and the masses of its vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::cloth {

/// Stiffnesses of a sheet, thickness included.
struct Material {
  double density = 0.2;       ///< kg/m^2, > 0
  double young = 1000;        ///< N/m: Young's modulus times thickness, > 0
  double poisson = 0.3;       ///< in [0, 0.5]
  double bending = 2e-5;      ///< N m: the energy is this times [W07]'s E_b, >= 0
  double mass_damping = 0;    ///< alpha_1 of [W07] equation (9), 1/s, >= 0
  double strain_damping = 0;  ///< alpha_2 of the same, s, >= 0
};

/// A sheet in its rest state.
struct Plate {
  Points rest;  ///< #V x 3, metres
  Topology topology;
  Material material;
  std::vector<std::uint8_t> fixed;  ///< #V, 1 for fixed vertices
  PerVertex mass;                   ///< #V, kg: [W07]'s rho M, lumped
};

/// `fixed` may be empty: no vertex is fixed.
Plate make_plate(const Points& rest, const Triangles& F, const Material& material,
                 std::vector<std::uint8_t> fixed = {});

/// The vertices of each triangle and of each hinge, over which the terms of the energy sum.
CompressedRows triangle_rows(const Topology& topology);
CompressedRows hinge_rows(const Topology& topology);
/// Both.
CompressedRows element_rows(const Topology& topology);

}  // namespace ibmfair::cloth
