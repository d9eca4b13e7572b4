// Scalar fields on a mesh, for visualization. A new field is one function and one row of the table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// The quality of each triangle, #F: 4 sqrt(3) area / sum of the squared edge lengths. It is 1 for
/// an equilateral triangle and 0 for a triangle without area, even if its corners coincide.
Eigen::VectorXd triangle_qualities(const Points& X, const Triangles& F);

/// A state of a mesh for which fields are computed.
struct FieldState {
  const Points& X;
  const Topology& topology;
  const Points* before = nullptr;  ///< earlier positions of the first vertices; null: none
  std::string_view laplacian = "crouzeix-raviart";  ///< of the bending energy
};

/// A row of the table.
struct SurfaceField {
  enum class Place : std::uint8_t { vertex, triangle };

  std::string_view name;   ///< name used in files
  std::string_view title;  ///< title shown to users
  std::string_view unit;   ///< empty: a pure number
  int dimension;           ///< the power of length in the unit
  bool diverging;          ///< signed: 0 is the middle of the colour scale
  Place place;
  bool needs_before;
  Eigen::VectorXd (*values)(const FieldState& state);  ///< NaN if undefined
};

/// All fields.
std::span<const SurfaceField> surface_fields();

/// The field with this name. Throws BadOption for an unknown name; the message lists the known
/// names.
const SurfaceField& surface_field(std::string_view name);

/// The range of values that a colour scale resolves.
struct ValueRange {
  double low = 0, high = 0;
};

/// The range from the 1 % to the 99 % quantile of `values` (the values of `field`), weighted by the
/// surface area of `state`, so that a few outliers do not take up most of the colours. For a
/// diverging field the range is symmetric about 0. Values that differ by rounding errors only are
/// not spread over all colours.
ValueRange robust_range(const SurfaceField& field, const Eigen::VectorXd& values,
                        const FieldState& state);

}  // namespace ibmfair
