// The mass matrices of the family, [W07] section 2.1: (M1) symmetric positive definite, (M2)
// scaling with length^2, (M3) summing up to the area.
#pragma once

#include <span>
#include <string_view>

#include "ibmfair/energy/triangle_shape.h"

namespace ibmfair {

struct BendingModel;
struct EnergyOptions;

/// A row of the table of masses.
struct MassMatrix {
  enum class Kind : std::uint8_t {
    edges,       ///< diagonal, one number an edge
    lumped,      ///< diagonal, one number a vertex: the sum of what its triangles give it
    consistent,  ///< of linear elements, whose row sums are what the triangles give
    counted,     ///< diagonal, a number a vertex that counts its triangles: no areas
    identity
  };

  std::string_view name;     ///< as the command line takes it
  std::string_view summary;  ///< one line
  Kind kind;
  TriangleFormula shares;  ///< of the corners in a triangle, length^2 or a count; unused for edges

  /// (M2) and (M3); without, the energy depends on the sampling.
  bool measures_area() const { return kind != Kind::counted && kind != Kind::identity; }
};

/// All masses.
std::span<const MassMatrix> mass_matrices();

/// Triangles at a vertex that valence counts as 1: those of a regular one.
inline constexpr double regular_valence = 6;

/// The mass that the options ask for: `none` where `mass` is false, the model's default where no
/// name is given. Throws BadOption for a name that does not go with the model, naming those that
/// do.
const MassMatrix& mass_matrix(const BendingModel& model, const EnergyOptions& options);

/// The first of the model's masses that measures areas.
const MassMatrix& area_mass(const BendingModel& model);

/// Signed areas of the parts of a triangle that are nearest to its corners: on a Delaunay
/// triangulation they add up to the Voronoi cells, and do not jump where an edge flips.
struct CircumcentricShares {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    ByCorner<Number> result;
    for (int i = 0; i < 3; ++i) {
      const int j = next(i), k = previous(i);
      result[i] = 0.125 * (t.squared[j] * t.cot[j] + t.squared[k] * t.cot[k]);
    }
    return result;
  }
};

}  // namespace ibmfair
