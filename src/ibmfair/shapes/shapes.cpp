#include "ibmfair/shapes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/named_row.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/polyhedra.h"
#include "ibmfair/shapes/six_sided_hole.h"

namespace ibmfair {

namespace {

constexpr std::array<std::string_view, 2> split{"subdivide", "refine-face"};
constexpr std::array<std::string_view, 3> split_sphere{"subdivide", "refine-face", "jitter"};
constexpr std::array<std::string_view, 1> levels{"subdivide"};
constexpr std::array<std::string_view, 4> grid{"ratio", "rows", "columns", "straight"};
constexpr std::array<std::string_view, 5> jittered_grid{"ratio", "rows", "columns", "straight",
                                                        "jitter"};

Jitter jitter_of(const ShapeSettings& settings) {
  return {settings.jitter.value_or(0.0), settings.seed};
}

template <TriangleMesh (*make)(const Subdivision&)>
TriangleMesh polyhedron(const ShapeSettings& settings) {
  return make({settings.subdivide.value_or(0), settings.refine_face});
}

template <TriangleMesh (*make)(const Subdivision&)>
TriangleMesh sphere(const ShapeSettings& settings) {
  TriangleMesh mesh = polyhedron<make>(settings);
  jitter_on_unit_sphere(mesh.X, mesh.F, jitter_of(settings));
  return mesh;
}

TriangleMesh six_sided_hole(const ShapeSettings& settings) {
  return make_six_sided_hole(settings.subdivide.value_or(4));
}

TriangleMesh rows(TriangleMesh (*make)(double, const GridSize&), double default_ratio,
                  const ShapeSettings& settings) {
  return make(settings.ratio.value_or(default_ratio),
              {settings.rows, settings.columns, settings.straight, jitter_of(settings)});
}

void require_applicable(const Shape& shape, const ShapeSettings& settings) {
  const std::array<std::pair<std::string_view, bool>, 7> given{{
      {"subdivide", settings.subdivide.has_value()},
      {"refine-face", settings.refine_face.has_value()},
      {"ratio", settings.ratio.has_value()},
      {"rows", settings.rows.has_value()},
      {"columns", settings.columns.has_value()},
      {"straight", settings.straight},
      {"jitter", settings.jitter.has_value()},
  }};
  for (const auto& [name, is_given] : given) {
    if (is_given &&
        std::find(shape.settings.begin(), shape.settings.end(), name) == shape.settings.end()) {
      throw BadOption(fmt::format("the shape '{}' takes no --{}; it takes --{}", shape.name, name,
                                  fmt::join(shape.settings, ", --")));
    }
  }
}

}  // namespace

std::span<const Shape> shapes() {
  static constexpr std::array table{
      Shape{"icosahedron", "flat faces, vertices of the icosahedron on the unit sphere", split,
            polyhedron<make_icosahedron>},
      Shape{"icosphere", "all vertices on the unit sphere", split_sphere, sphere<make_icosphere>},
      Shape{"cube", "flat faces, side 2", split, polyhedron<make_cube>},
      Shape{"cubesphere", "the same, put onto the unit sphere: right-angled triangles",
            split_sphere, sphere<make_cubesphere>},
      Shape{"hexagon", "flat and six-sided, radius 1", split, polyhedron<make_hexagon>},
      Shape{"six-sided-hole", "two rings of a smooth surface around a trivial filling", levels,
            six_sided_hole},
      Shape{"torus", "about the z axis, radii 1 and 1/RATIO (sqrt 2)", jittered_grid,
            [](const ShapeSettings& s) { return rows(make_torus, std::sqrt(2.0), s); }},
      Shape{"cylinder", "open, about the z axis, radius 1, height RATIO (2)", jittered_grid,
            [](const ShapeSettings& s) { return rows(make_cylinder, 2.0, s); }},
      Shape{"catenoid", "open, about the z axis, smallest radius 1, height RATIO (2)",
            jittered_grid, [](const ShapeSettings& s) { return rows(make_catenoid, 2.0, s); }},
      Shape{"plane", "flat, width 1, height RATIO (1)", grid,
            [](const ShapeSettings& s) { return rows(make_plane, 1.0, s); }},
  };
  return table;
}

Mesh make_shape(std::string_view name, const ShapeSettings& settings) {
  const Shape& shape = row_named(shapes(), "shape", name);
  require_applicable(shape, settings);
  TriangleMesh mesh = shape.make(settings);
  return mesh_from_triangles(std::move(mesh.X), mesh.F);
}

}  // namespace ibmfair
