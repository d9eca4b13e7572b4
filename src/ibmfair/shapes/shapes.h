// The table of shapes that can be made by name. A new shape is one function and one row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

struct TriangleMesh;  // shapes/subdivide.h

/// The settings of shapes. Each shape takes some of these; Shape::settings lists them by the names
/// given here.
struct ShapeSettings {
  std::optional<int> subdivide = {};      ///< "subdivide"
  std::optional<Index> refine_face = {};  ///< "refine-face"
  std::optional<double> ratio = {};       ///< "ratio"
  std::optional<Index> rows = {};         ///< "rows"
  std::optional<Index> columns = {};      ///< "columns"
  bool straight = false;                  ///< "straight"
  std::optional<double> jitter = {};      ///< "jitter"
  std::uint64_t seed = 1;                 ///< of the random jitter
};

/// A row of the table.
struct Shape {
  std::string_view name;
  std::string_view summary;                    ///< one line, with the meaning of `ratio`
  std::span<const std::string_view> settings;  ///< the names of the settings that it takes
  TriangleMesh (*make)(const ShapeSettings& settings);
};

/// All shapes.
std::span<const Shape> shapes();

/// Makes the shape of that name. Throws BadOption for an unknown name, for a setting that the shape
/// does not take, and for values out of range (shapes/polyhedra.h, shapes/grids.h).
Mesh make_shape(std::string_view name, const ShapeSettings& settings = {});

}  // namespace ibmfair
