#include "ibmfair/shapes/six_sided_hole.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "ibmfair/base/errors.h"
#include "ibmfair/shapes/loop_subdivision.h"

namespace ibmfair {
namespace {

constexpr Index lattice_radius = 4;  // rings of control vertices: two in the piece, two around it
constexpr double radius = 2;         // radius of the piece, in edges of the control mesh
constexpr double steepness = 0.1;    // of the monkey saddle on which the control vertices lie

/// The side length of the regular hexagon about the origin through (x, y) with corners on the x
/// axis.
double hexagon_distance(double x, double y) {
  const double height = std::numbers::sqrt3 / 2;
  return std::max({std::abs(y), std::abs(x * height + y / 2), std::abs(x * height - y / 2)}) /
         height;
}

/// A hexagonal piece of the triangular lattice, with z = steepness * Re (x + iy)^3.
TriangleMesh control_mesh() {
  constexpr Index n = 2 * lattice_radius + 1;
  std::array<std::array<Index, n>, n> number{};
  std::vector<Vec3> points;
  const auto inside = [](Index q, Index r) {
    return std::max({std::abs(q), std::abs(r), std::abs(q + r)}) <= lattice_radius;
  };
  for (Index r = -lattice_radius; r <= lattice_radius; ++r) {
    for (Index q = -lattice_radius; q <= lattice_radius; ++q) {
      if (inside(q, r)) {
        const double x = q + r / 2.0, y = r * std::numbers::sqrt3 / 2;
        number[q + lattice_radius][r + lattice_radius] = static_cast<Index>(points.size());
        points.emplace_back(x, y, steepness * (x * x * x - 3 * x * y * y));
      }
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  const auto add = [&](std::array<std::array<Index, 2>, 3> corners) {
    std::array<Index, 3> triangle{};
    for (int i = 0; i < 3; ++i) {
      if (!inside(corners[i][0], corners[i][1])) {
        return;
      }
      triangle[i] = number[corners[i][0] + lattice_radius][corners[i][1] + lattice_radius];
    }
    triangles.push_back(triangle);
  };
  for (Index r = -lattice_radius; r <= lattice_radius; ++r) {
    for (Index q = -lattice_radius; q <= lattice_radius; ++q) {
      add({{{q, r}, {q + 1, r}, {q, r + 1}}});
      add({{{q + 1, r}, {q + 1, r + 1}, {q, r + 1}}});
    }
  }
  return {Eigen::Map<const Points>(points.front().data(), std::ssize(points), 3),
          Eigen::Map<const Triangles>(triangles.front().data(), std::ssize(triangles), 3)};
}

/// The part of the mesh within the hexagon with the given side length.
TriangleMesh cut_hexagon(const TriangleMesh& mesh, double side) {
  std::vector<Index> number(static_cast<std::size_t>(mesh.X.rows()), -1), kept;
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    if (hexagon_distance(mesh.X(v, 0), mesh.X(v, 1)) <= side) {
      number[v] = static_cast<Index>(kept.size());
      kept.push_back(v);
    }
  }
  TriangleMesh piece;
  piece.X = mesh.X(kept, Eigen::all);
  std::vector<Index> corners;
  for (const auto x : mesh.F.rowwise()) {
    if (number[x[0]] >= 0 && number[x[1]] >= 0 && number[x[2]] >= 0) {
      corners.insert(corners.end(), {number[x[0]], number[x[1]], number[x[2]]});
    }
  }
  piece.F =
      Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  return piece;
}

/// The heights of the hexagon's corners, counter-clockwise from the x axis.
std::array<double, 6> corner_heights(const TriangleMesh& piece) {
  std::array<double, 6> heights{};
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    const Eigen::RowVector2d corner(radius * std::cos(angle), radius * std::sin(angle));
    Eigen::Index nearest = 0;
    (piece.X.leftCols(2).rowwise() - corner).rowwise().squaredNorm().minCoeff(&nearest);
    heights[i] = piece.X(nearest, 2);
  }
  return heights;
}

/// The height of six flat triangles between the corners and their mean.
double trivial_height(double x, double y, const std::array<double, 6>& heights) {
  double mean = 0;
  for (const double height : heights) {
    mean += height / 6;
  }
  const double angle = std::atan2(y, x) + (y < 0 ? 2 * std::numbers::pi : 0);
  const int sector = std::min(5, static_cast<int>(angle / (std::numbers::pi / 3)));
  // (x, y) = u * one corner + v * the next.
  const double start = sector * std::numbers::pi / 3;
  const double along = x * std::cos(start) + y * std::sin(start);
  const double across = y * std::cos(start) - x * std::sin(start);
  const double v = across / (std::numbers::sqrt3 / 2) / radius;
  const double u = along / radius - v / 2;
  return mean + u * (heights[sector] - mean) + v * (heights[(sector + 1) % 6] - mean);
}

}  // namespace

TriangleMesh make_six_sided_hole(int subdivide) {
  if (subdivide < 1) {
    throw BadOption("--subdivide: the six-sided hole must be subdivided at least once");
  }
  require_shape_size(96 * std::pow(4.0, subdivide));
  TriangleMesh mesh = control_mesh();
  for (int i = 0; i < subdivide; ++i) {
    mesh = loop_subdivide(mesh);
  }
  const double edge = std::ldexp(1.0, -subdivide);
  TriangleMesh piece = cut_hexagon(mesh, radius + edge / 2);
  const std::array<double, 6> heights = corner_heights(piece);
  for (auto x : piece.X.rowwise()) {
    if (hexagon_distance(x[0], x[1]) < radius - 1.5 * edge) {
      x[2] = trivial_height(x[0], x[1], heights);
    }
  }
  return piece;
}

}  // namespace ibmfair
