#include "ibmfair/shapes/grids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr Index default_size = 32;

struct Counts {
  Index rows;
  Index columns;
};

/// The requirements of a shape for its grid.
struct Layout {
  double length;        // sum of the distances between rows, relative to the length of a row
  bool closed_rows;     // the last row is a neighbour of the first one
  bool closed_columns;  // the last vertex of a row is a neighbour of the first one
  Index smallest_rows;
  Index smallest_columns;
};

void require(std::string_view what, Index count, Index smallest, bool even) {
  if (count < smallest || (even && count % 2 != 0)) {
    throw BadOption(fmt::format("{}: {} does not fit this shape; it must be at least {}{}", what,
                                count, smallest, even ? " and, without --straight, even" : ""));
  }
}

Index rounded(double value, Index smallest) {
  require_shape_size(value);
  return std::max(smallest, static_cast<Index>(std::lround(value)));
}

Counts complete(const GridSize& size, const Layout& layout) {
  const double rows_per_column = layout.length * (size.straight ? 1.0 : 2.0 / std::sqrt(3.0));
  const Index more_rows = layout.closed_rows ? 0 : 1;
  const Index more_columns = layout.closed_columns ? 0 : 1;
  const bool even = layout.closed_rows && !size.straight;

  // Start from the number that is given; if none is, from that of the shorter direction.
  const bool by_rows = size.rows && !size.columns;
  const bool by_default_rows = !size.rows && !size.columns && rows_per_column < 1.0;
  Counts counts{size.rows.value_or(default_size), size.columns.value_or(default_size)};
  if (by_rows || by_default_rows) {
    counts.columns = rounded((counts.rows - more_rows) / rows_per_column + more_columns,
                             layout.smallest_columns);
  } else if (!size.rows) {
    counts.rows = rounded((counts.columns - more_columns) * rows_per_column + more_rows,
                          layout.smallest_rows);
    counts.rows += even ? counts.rows % 2 : 0;
  }
  require("--rows", counts.rows, layout.smallest_rows, even);
  require("--columns", counts.columns, layout.smallest_columns, false);
  require_shape_size(2.0 * counts.rows * counts.columns);
  return counts;
}

void require_ratio(double ratio, double smallest) {
  constexpr double largest = 1e6;
  if (!(ratio > smallest && ratio <= largest)) {
    throw BadOption(fmt::format("--ratio: {} is out of range; it must be above {} and at most {}",
                                ratio, smallest, largest));
  }
}

// The triangles between closed rows. Their normals point along (direction along a row) x (direction
// to the next row).
Triangles ring_triangles(const Counts& counts, bool closed, bool straight) {
  const Index strips = closed ? counts.rows : counts.rows - 1;
  Triangles F(2 * static_cast<Eigen::Index>(strips) * counts.columns, 3);
  Eigen::Index f = 0;
  for (Index i = 0; i < strips; ++i) {
    const Index lower = i * counts.columns;
    const Index upper = (i + 1) % counts.rows * counts.columns;
    const bool lower_shifted = !straight && i % 2 == 1;
    for (Index j = 0; j < counts.columns; ++j) {
      const Index next = (j + 1) % counts.columns;
      // If the lower row is shifted, its vertex j lies between vertices j and j + 1 of the upper
      // row.
      if (lower_shifted) {
        F.row(f++) << lower + j, upper + next, upper + j;
        F.row(f++) << lower + j, lower + next, upper + next;
      } else {
        F.row(f++) << lower + j, lower + next, upper + j;
        F.row(f++) << lower + next, upper + next, upper + j;
      }
    }
  }
  return F;
}

double shift(Index row, bool straight) {
  return !straight && row % 2 == 1 ? 0.5 : 0.0;
}

/// A mesh of closed rows. In position(u, v), u is the angle along a row, 0 .. 2 pi, and v runs from
/// 0 to 1 across all rows. Jitter does not move the first and the last row in the direction of v
/// unless they are neighbours.
template <class Position>
TriangleMesh rings(const Counts& counts, bool closed, const GridSize& size,
                   const Position& position) {
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(counts.rows) * counts.columns, 3),
                    ring_triangles(counts, closed, size.straight)};
  RandomOffsets offsets(size.jitter);
  const Index cells = closed ? counts.rows : counts.rows - 1;
  for (Index i = 0; i < counts.rows; ++i) {
    const bool stays = !closed && (i == 0 || i == cells);
    for (Index j = 0; j < counts.columns; ++j) {
      const double along = offsets.next(), across = offsets.next();
      const double u = (j + shift(i, size.straight) + along) / counts.columns;
      const double v = (i + (stays ? 0.0 : across)) / cells;
      mesh.X.row(static_cast<Eigen::Index>(i) * counts.columns + j) = position(two_pi * u, v);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh make_torus(double ratio, const GridSize& size) {
  require_ratio(ratio, 1.0);
  const Counts counts = complete(size, {1.0 / ratio, true, true, size.straight ? 3 : 4, 3});

  const double r = 1.0 / ratio;
  return rings(counts, true, size, [r](double u, double v) {
    const double around = 1.0 + r * std::cos(two_pi * v);
    return Eigen::RowVector3d(around * std::cos(u), around * std::sin(u), r * std::sin(two_pi * v));
  });
}

TriangleMesh make_cylinder(double height, const GridSize& size) {
  require_ratio(height, 0.0);
  const Counts counts = complete(size, {height / two_pi, false, true, 2, 3});

  return rings(counts, false, size, [height](double u, double v) {
    return Eigen::RowVector3d(std::cos(u), std::sin(u), height * (v - 0.5));
  });
}

TriangleMesh make_catenoid(double height, const GridSize& size) {
  require_ratio(height, 0.0);
  if (height > 20.0) {
    throw BadOption(fmt::format(
        "--ratio: a catenoid of height {} is too wide; the height must be at most 20", height));
  }
  const Counts counts = complete(size, {height / two_pi, false, true, 2, 3});

  return rings(counts, false, size, [height](double u, double v) {
    const double z = height * (v - 0.5), radius = std::cosh(z);
    return Eigen::RowVector3d(radius * std::cos(u), radius * std::sin(u), z);
  });
}

TriangleMesh make_plane(double height, const GridSize& size) {
  require_ratio(height, 0.0);
  const Counts counts = complete(size, {height, false, false, 2, 2});

  // A shifted row has one vertex more than the others; its first and its last cell are half cells.
  const auto shifted = [&](Index row) { return shift(row, size.straight) > 0.0; };
  std::vector<Index> first{0};
  for (Index i = 0; i < counts.rows; ++i) {
    first.push_back(first.back() + counts.columns + (shifted(i) ? 1 : 0));
  }
  TriangleMesh mesh{Points(first.back(), 3), Triangles(2 * Eigen::Index{first.back()}, 3)};
  Eigen::Index f = 0;
  for (Index i = 0; i < counts.rows; ++i) {
    const Index lower = first[i];
    const Index upper = first[i + 1];
    const double y = height * i / (counts.rows - 1);
    for (Index j = 0; lower + j < upper; ++j) {
      const double x = (j - shift(i, size.straight)) / (counts.columns - 1);
      mesh.X.row(lower + j) << std::clamp(x, 0.0, 1.0), y, 0.0;
    }
    if (i + 1 < counts.rows) {
      // Triangles have their base on an edge of the lower row or on an edge of the upper row.
      const Index apex = shifted(i + 1) ? 1 : 0;
      for (Index j = 0; lower + j + 1 < upper; ++j) {
        mesh.F.row(f++) << lower + j, lower + j + 1, upper + j + apex;
      }
      for (Index j = 0; upper + j + 1 < first[i + 2]; ++j) {
        mesh.F.row(f++) << lower + j + 1 - apex, upper + j + 1, upper + j;
      }
    }
  }
  mesh.F.conservativeResize(f, 3);
  return mesh;
}

}  // namespace ibmfair
