// Scalar fields of a mesh for people to look at. A new one is one function and one row.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// 4 sqrt(3) area / sum of the squared edge lengths, #F: 1 for an equilateral triangle, 0 for one
/// without area, and for one whose corners are a single point.
Eigen::VectorXd triangle_qualities(const Points& X, const Triangles& F);

/// A state of a mesh that fields are computed of.
struct FieldState {
  const Points& X;
  const Topology& topology;
  const Points* before = nullptr;                   ///< of the first of its vertices; null: none
  std::string_view laplacian = "crouzeix-raviart";  ///< of the bending energy
};

/// A row of the table.
struct SurfaceField {
  enum class Place : std::uint8_t { vertex, triangle };

  std::string_view name;   ///< as files call it
  std::string_view title;  ///< for people
  std::string_view unit;   ///< empty: a pure number
  int dimension;           ///< the power of length in the unit
  bool diverging;          ///< signed: 0 is the middle
  Place place;
  bool needs_before;
  Eigen::VectorXd (*values)(const FieldState& state);  ///< NaN where there is none
};

/// All fields.
std::span<const SurfaceField> surface_fields();

/// The field of that name; throws BadOption, naming those there are.
const SurfaceField& surface_field(std::string_view name);

/// From where to where values are worth telling apart.
struct ValueRange {
  double low = 0, high = 0;
};

/// From the value that lies above 1 % of the surface of `state` to the one above 99 % of it, so
/// that a few wild vertices do not take all colours; for a diverging field symmetric about 0.
/// `values` are the field's. What differs by rounding only is not spread over all colours.
ValueRange robust_range(const SurfaceField& field, const Eigen::VectorXd& values,
                        const FieldState& state);

}  // namespace ibmfair
