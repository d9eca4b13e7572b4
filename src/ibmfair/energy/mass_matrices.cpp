#include "ibmfair/energy/mass_matrices.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/named_row.h"
#include "ibmfair/energy/bending_energy.h"

namespace ibmfair {
namespace {

/// A third of the area for each corner: the row sums of the mass matrix of linear elements.
struct ThirdsOfArea {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    const Number third = (1.0 / 3.0) * t.area;
    return {third, third, third};
  }
};

/// M. Meyer, M. Desbrun, P. Schroeder, A. Barr, "Discrete differential-geometry operators for
/// triangulated 2-manifolds" (2003): Voronoi areas; in an obtuse triangle, half the area for the
/// obtuse corner and a quarter for each of the others. At a right angle both rules agree.
struct MixedVoronoiShares {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>& t) {
    for (int i = 0; i < 3; ++i) {
      if (value_of(t.cot[i]) < 0) {
        ByCorner<Number> result{0.25 * t.area, 0.25 * t.area, 0.25 * t.area};
        result[i] = 0.5 * t.area;
        return result;
      }
    }
    return CircumcentricShares::at(t);
  }
};

struct SixthsOfOne {
  template <class Number>
  static ByCorner<Number> at(const TriangleShape<Number>&) {
    const Number sixth = 1 / regular_valence;
    return {sixth, sixth, sixth};
  }
};

constexpr std::array<MassMatrix, 6> masses{{
    {"crouzeix-raviart", "of edges: a third of the area of the two triangles",
     MassMatrix::Kind::edges, triangle_formula<ThirdsOfArea>},
    {"barycentric", "a third of the area around each vertex", MassMatrix::Kind::lumped,
     triangle_formula<ThirdsOfArea>},
    {"voronoi", "the area nearest to each vertex, kept within obtuse triangles",
     MassMatrix::Kind::lumped, triangle_formula<MixedVoronoiShares>},
    {"galerkin", "the full mass of linear elements, solved with at every evaluation",
     MassMatrix::Kind::consistent, triangle_formula<ThirdsOfArea>},
    {"valence", "the number of triangles around each vertex, over six: depends on the sampling",
     MassMatrix::Kind::counted, triangle_formula<SixthsOfOne>},
    {"none", "the identity: the energy depends on the sampling", MassMatrix::Kind::identity,
     triangle_formula<ThirdsOfArea>},
}};

}  // namespace

std::span<const MassMatrix> mass_matrices() {
  return masses;
}

const MassMatrix& mass_matrix(const BendingModel& model, const EnergyOptions& options) {
  const std::string_view name = !options.mass                 ? std::string_view("none")
                                : options.mass_matrix.empty() ? model.masses.front()
                                                              : options.mass_matrix;
  const bool fits = std::find(model.masses.begin(), model.masses.end(), name) != model.masses.end();
  if (!fits) {
    throw BadOption(
        fmt::format("the Laplacian {} has no mass matrix '{}'; choose one by --mass: {}",
                    model.name, name, fmt::join(model.masses, ", ")));
  }
  return row_named(mass_matrices(), "mass", name);
}

const MassMatrix& area_mass(const BendingModel& model) {
  const auto found =
      std::find_if(model.masses.begin(), model.masses.end(), [](std::string_view name) {
        return row_named(mass_matrices(), "mass", name).measures_area();
      });
  return row_named(mass_matrices(), "mass", *found);
}

}  // namespace ibmfair
