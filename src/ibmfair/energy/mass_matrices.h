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
    edges,       ///< diagonal, one number per edge
    lumped,      ///< diagonal, one number per vertex: the sum of its triangles' shares
    consistent,  ///< of linear elements; its row sums are the sums of the shares
    counted,     ///< diagonal, per vertex a multiple of its number of triangles: no areas
    identity
  };

  std::string_view name;     ///< the name used on the command line
  std::string_view summary;  ///< one line
  Kind kind;
  TriangleFormula shares;  ///< of a triangle's corners, length^2 or a count; unused for edges

  /// Whether (M2) and (M3) hold. If not, the energy depends on the sampling.
  bool measures_area() const { return kind != Kind::counted && kind != Kind::identity; }
};

/// All masses.
std::span<const MassMatrix> mass_matrices();

/// The number of triangles at a regular vertex, for which the mass `valence` is 1.
inline constexpr double regular_valence = 6;

/// The mass matrix selected by the options: `none` if `mass` is false, the model's default if no
/// name is given. Throws BadOption for a name that cannot be combined with the model; the message
/// lists the valid names.
const MassMatrix& mass_matrix(const BendingModel& model, const EnergyOptions& options);

/// The first of the model's masses that measures areas.
const MassMatrix& area_mass(const BendingModel& model);

/// For each corner of a triangle, the signed area of the points nearest to that corner. On a
/// Delaunay triangulation these areas add up to the Voronoi cells, and they do not jump when an
/// edge flips.
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
