#include "cloth/sheet_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/shapes/grids.h"

namespace ibmfair::cloth {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Point = Eigen::Vector2d;

constexpr double jitter = 0.15;  // standard deviation, of the points' distance

std::vector<Point> points_on_border(Index side) {
  std::vector<Point> points;
  for (Index i = 0; i < side; ++i) {
    const double s = static_cast<double>(i) / side;
    points.insert(points.end(), {{s, 0}, {1, s}, {1 - s, 1}, {0, 1 - s}});
  }
  return points;
}

/// `count` points that keep a distance from the border. The recurrence with the powers of the
/// inverse plastic number spreads any number of points evenly (Roberts 2018).
std::vector<Point> points_within(Index count, double spacing) {
  constexpr double plastic = 1.32471795724474602596;
  RandomNumbers random(count);
  const auto inside = [&](double x) {
    const double moved = spacing * (0.8 + jitter * random.normal()) + x * (1 - 1.6 * spacing);
    return std::clamp(moved, 0.4 * spacing, 1 - 0.4 * spacing);
  };
  std::vector<Point> points;
  for (Index i = 1; i <= count; ++i) {
    const double x = i / plastic, y = i / (plastic * plastic);
    points.emplace_back(inside(x - std::floor(x)), inside(y - std::floor(y)));
  }
  return points;
}

/// Sorts the points strip by strip, like the rows of a grid, so that neighbours are close in
/// memory.
void sort_by_strips(std::vector<Point>& points, Index strips) {
  const auto strip = [strips](const Point& p) { return std::floor(p.y() * strips); };
  std::sort(points.begin(), points.end(), [&](const Point& a, const Point& b) {
    return std::make_pair(strip(a), a.x()) < std::make_pair(strip(b), b.x());
  });
}

Triangles triangulate_points(const std::vector<Point>& points) {
  std::vector<std::pair<Kernel::Point_2, Index>> numbered;
  for (const Point& p : points) {
    numbered.emplace_back(Kernel::Point_2(p.x(), p.y()), static_cast<Index>(numbered.size()));
  }
  const Delaunay delaunay(numbered.begin(), numbered.end());
  std::vector<std::array<Index, 3>> rows;
  for (const auto& face : delaunay.finite_face_handles()) {
    std::array<Index, 3> row{face->vertex(0)->info(), face->vertex(1)->info(),
                             face->vertex(2)->info()};
    std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  Triangles F(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t t = 0; t < rows.size(); ++t) {
    F.row(static_cast<Eigen::Index>(t)) << rows[t][0], rows[t][1], rows[t][2];
  }
  return F;
}

}  // namespace

TriangleMesh regular_sheet(Index vertices) {
  const auto side = static_cast<Index>(std::lround(std::sqrt(vertices)));
  return make_plane(1, {side, side, true});
}

TriangleMesh irregular_sheet(Index vertices) {
  const auto side = static_cast<Index>(std::lround(std::sqrt(vertices))) - 1;
  std::vector<Point> points = points_on_border(side);
  const std::vector<Point> within =
      points_within(vertices - static_cast<Index>(points.size()), 1.0 / side);
  points.insert(points.end(), within.begin(), within.end());
  sort_by_strips(points, side);
  TriangleMesh mesh{Points::Zero(vertices, 3), triangulate_points(points)};
  for (Index v = 0; v < vertices; ++v) {
    mesh.X.row(v).head<2>() = points[static_cast<std::size_t>(v)];
  }
  return mesh;
}

std::span<const SheetMesh> sheet_meshes() {
  static constexpr std::array table{SheetMesh{"regular", regular_sheet},
                                    SheetMesh{"irregular", irregular_sheet}};
  return table;
}

}  // namespace ibmfair::cloth
