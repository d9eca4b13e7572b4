#include "ibmfair/shapes/polyhedra.h"

#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

namespace {

constexpr int most_levels = 12;

void keep_in_place(Points& /*X*/, Eigen::Index /*first_new*/) {}

void project_to_unit_sphere(Points& X, Eigen::Index first_new) {
  for (Eigen::Index v = first_new; v < X.rows(); ++v) {
    X.row(v).normalize();
  }
}

// `place` moves the vertices that a subdivision has added to their positions.
TriangleMesh subdivide(TriangleMesh mesh, const Subdivision& subdivision,
                       void (*place)(Points& X, Eigen::Index first_new)) {
  const auto polyhedron_faces = mesh.F.rows();
  if (subdivision.levels < 0 || subdivision.levels > most_levels) {
    throw BadOption(fmt::format("--subdivide: {} is out of range; it must be from 0 to {}",
                                subdivision.levels, most_levels));
  }
  if (subdivision.refined_face &&
      (*subdivision.refined_face < 0 || *subdivision.refined_face >= polyhedron_faces)) {
    throw BadOption(fmt::format("--refine-face: there is no face {}; the shape has faces 0 to {}",
                                *subdivision.refined_face, polyhedron_faces - 1));
  }
  const Eigen::Index children = Eigen::Index{1} << (2 * subdivision.levels);
  require_shape_size(static_cast<double>(polyhedron_faces * children));

  for (int level = 0; level < subdivision.levels; ++level) {
    const Eigen::Index first_new = mesh.X.rows();
    mesh = split_all_triangles(mesh);
    place(mesh.X, first_new);
  }
  if (subdivision.refined_face) {
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(mesh.F.rows()), 0);
    const auto first = marked.begin() + *subdivision.refined_face * children;
    std::fill(first, first + children, 1);
    const Eigen::Index first_new = mesh.X.rows();
    mesh = split_triangles(mesh, std::move(marked));
    place(mesh.X, first_new);
  }
  return mesh;
}

// Makes a mesh from plain lists, which are read row by row and compile faster than Eigen's comma
// initialiser.
template <std::size_t VertexCount, std::size_t FaceCount>
TriangleMesh from_lists(const double (&positions)[VertexCount][3],
                        const Index (&corners)[FaceCount][3]) {
  return {Eigen::Map<const Points>(&positions[0][0], VertexCount, 3),
          Eigen::Map<const Triangles>(&corners[0][0], FaceCount, 3)};
}

TriangleMesh icosahedron() {
  const double p = 0.5 * (1.0 + std::sqrt(5.0));
  const double positions[12][3] = {{-1, p, 0}, {1, p, 0}, {-1, -p, 0}, {1, -p, 0},
                                   {0, -1, p}, {0, 1, p}, {0, -1, -p}, {0, 1, -p},
                                   {p, 0, -1}, {p, 0, 1}, {-p, 0, -1}, {-p, 0, 1}};
  constexpr Index corners[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  TriangleMesh mesh = from_lists(positions, corners);
  mesh.X.rowwise().normalize();
  return mesh;
}

TriangleMesh cube() {
  constexpr double positions[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  constexpr Index corners[12][3] = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7},
                                    {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                    {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  return from_lists(positions, corners);
}

}  // namespace

TriangleMesh make_icosahedron(const Subdivision& subdivision) {
  return subdivide(icosahedron(), subdivision, keep_in_place);
}

TriangleMesh make_icosphere(const Subdivision& subdivision) {
  return subdivide(icosahedron(), subdivision, project_to_unit_sphere);
}

TriangleMesh make_cube(const Subdivision& subdivision) {
  return subdivide(cube(), subdivision, keep_in_place);
}

TriangleMesh make_cubesphere(const Subdivision& subdivision) {
  TriangleMesh corners = cube();
  corners.X.rowwise().normalize();
  return subdivide(corners, subdivision, project_to_unit_sphere);
}

TriangleMesh make_hexagon(const Subdivision& subdivision) {
  const double h = 0.5 * std::sqrt(3.0);
  const double positions[7][3] = {{0, 0, 0},  {1, 0, 0},     {0.5, h, 0}, {-0.5, h, 0},
                                  {-1, 0, 0}, {-0.5, -h, 0}, {0.5, -h, 0}};
  constexpr Index corners[6][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4},
                                   {0, 4, 5}, {0, 5, 6}, {0, 6, 1}};
  return subdivide(from_lists(positions, corners), subdivision, keep_in_place);
}

}  // namespace ibmfair
