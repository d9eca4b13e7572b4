#include "support/solids.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair::test {
namespace {

using Corners = std::array<Index, 3>;

Mesh mesh_of(const std::vector<Vec3>& points, const std::vector<Corners>& triangles) {
  Mesh mesh;
  mesh.X.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.X.row(static_cast<Eigen::Index>(v)) = points[v];
  }
  for (const Corners& triangle : triangles) {
    mesh.faces.add(triangle);
  }
  return mesh;
}

/// The grid points of a mesh, each once.
class GridPoints {
 public:
  using Place = std::array<Index, 3>;

  Index number(const Place& place) {
    const auto [found, is_new] = number_.try_emplace(place, static_cast<Index>(places_.size()));
    if (is_new) {
      places_.push_back(place);
    }
    return found->second;
  }

  const std::vector<Place>& places() const { return places_; }

 private:
  std::map<Place, Index> number_;
  std::vector<Place> places_;
};

/// The two triangles of the face of cell (i,j,k) on the side `up` of `axis`, outward.
void add_face(GridPoints::Place cell, int axis, bool up, GridPoints& points,
              std::vector<Corners>& triangles) {
  const int right = (axis + 1) % 3, top = (axis + 2) % 3;
  cell[axis] += up ? 1 : 0;
  std::array<Index, 4> corners{};
  for (int c = 0; c < 4; ++c) {
    GridPoints::Place place = cell;
    place[right] += c == 1 || c == 2 ? 1 : 0;
    place[top] += c >= 2 ? 1 : 0;
    corners[c] = points.number(place);
  }
  const auto [a, b, c, d] = corners;
  if (up) {
    triangles.insert(triangles.end(), {Corners{a, b, c}, Corners{a, c, d}});
  } else {
    triangles.insert(triangles.end(), {Corners{a, c, b}, Corners{a, d, c}});
  }
}

std::vector<double> steps(Index count) {
  std::vector<double> result(static_cast<std::size_t>(count) + 1);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

/// 0, thickness, thickness + 1, ..., and, with `both`, another step of `thickness`.
std::vector<double> steps_behind_a_wall(Index count, double thickness, bool both) {
  std::vector<double> result{0};
  for (Index i = 0; i <= count; ++i) {
    result.push_back(thickness + i);
  }
  if (both) {
    result.push_back(2 * thickness + count);
  }
  return result;
}

}  // namespace

Mesh solid_of_cells(const std::vector<double>& x, const std::vector<double>& y,
                    const std::vector<double>& z,
                    const std::function<bool(Index, Index, Index)>& is_inside) {
  const std::array<const std::vector<double>*, 3> axes{&x, &y, &z};
  const auto inside = [&](const GridPoints::Place& cell) {
    for (int i = 0; i < 3; ++i) {
      if (cell[i] < 0 || cell[i] + 1 >= std::ssize(*axes[i])) {
        return false;
      }
    }
    return is_inside(cell[0], cell[1], cell[2]);
  };
  GridPoints points;
  std::vector<Corners> triangles;
  for (Index i = 0; i + 1 < std::ssize(x); ++i) {
    for (Index j = 0; j + 1 < std::ssize(y); ++j) {
      for (Index k = 0; k + 1 < std::ssize(z); ++k) {
        for (int side = 0; inside({i, j, k}) && side < 6; ++side) {
          GridPoints::Place beside{i, j, k};
          beside[side / 2] += side % 2 == 0 ? -1 : 1;
          if (!inside(beside)) {
            add_face({i, j, k}, side / 2, side % 2 == 1, points, triangles);
          }
        }
      }
    }
  }
  std::vector<Vec3> positions;
  for (const auto& [i, j, k] : points.places()) {
    positions.emplace_back(x[i], y[j], z[k]);
  }
  return mesh_of(positions, triangles);
}

Mesh plate(Index columns, Index rows, double thickness) {
  return solid_of_cells(steps(columns), steps(rows), {0, thickness},
                        [](Index, Index, Index) { return true; });
}

Mesh tray(Index columns, Index height, double thickness) {
  const std::vector<double> across = steps_behind_a_wall(columns, thickness, true);
  return solid_of_cells(across, across, steps_behind_a_wall(height, thickness, false),
                        [&](Index i, Index j, Index k) {
                          const Index last = columns + 1;
                          return k == 0 || i == 0 || j == 0 || i == last || j == last;
                        });
}

Mesh angle_profile(Index columns, Index rows, double thickness) {
  const std::vector<double> across = steps_behind_a_wall(columns, thickness, false);
  return solid_of_cells(across, steps(rows), across,
                        [](Index i, Index, Index k) { return i == 0 || k == 0; });
}

Mesh washer(Index inner, Index outer, double thickness) {
  Mesh mesh = solid_of_cells(steps(outer - inner),
                             steps(static_cast<Index>(std::numbers::pi * (inner + outer))),
                             {0, thickness}, [](Index, Index, Index) { return true; });
  // The first and the last row of the plate become one; its faces there are left out.
  const double length = std::floor(std::numbers::pi * (inner + outer));
  std::vector<Vec3> points;
  std::map<std::array<double, 3>, Index> first;
  std::vector<Index> number;
  for (const auto& x : mesh.X.rowwise()) {
    const std::array<double, 3> place{x[0], x[1] == length ? 0 : x[1], x[2]};
    const auto [found, is_new] = first.try_emplace(place, static_cast<Index>(points.size()));
    number.push_back(found->second);
    if (is_new) {
      const double angle = 2 * std::numbers::pi * place[1] / length, radius = inner + place[0];
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), place[2]);
    }
  }
  std::vector<Corners> triangles;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    const auto y = [&](int i) { return mesh.X(corners[i], 1); };
    const bool is_end = y(0) == y(1) && y(1) == y(2) && (y(0) == 0 || y(0) == length);
    if (!is_end) {
      triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
    }
  }
  return mesh_of(points, triangles);
}

Mesh half_shell(Index radius, double thickness) {
  const auto rings = static_cast<Index>(radius * std::numbers::pi / 2);
  const Index around = 6 * radius;
  std::vector<Vec3> points;
  std::vector<Corners> triangles;
  for (const double r : {static_cast<double>(radius), radius - thickness}) {
    const auto pole = static_cast<Index>(points.size());
    const bool outer = pole == 0;
    const auto add = [&](Index a, Index b, Index c) {
      triangles.push_back(outer ? Corners{a, b, c} : Corners{a, c, b});
    };
    points.emplace_back(0, 0, r);
    for (Index i = 1; i <= rings; ++i) {
      const double down = std::numbers::pi / 2 * i / rings;
      for (Index j = 0; j < around; ++j) {
        const double angle = 2 * std::numbers::pi * j / around;
        points.emplace_back(r * std::sin(down) * std::cos(angle),
                            r * std::sin(down) * std::sin(angle), r * std::cos(down));
      }
    }
    for (Index j = 0; j < around; ++j) {
      const Index next = (j + 1) % around;
      add(pole, pole + 1 + j, pole + 1 + next);
      for (Index i = 0; i + 1 < rings; ++i) {
        const Index a = pole + 1 + i * around + j, b = pole + 1 + i * around + next;
        add(a, a + around, b + around);
        add(a, b + around, b);
      }
    }
  }
  const auto half = static_cast<Index>(points.size() / 2);
  for (Index j = 0; j < around; ++j) {
    const Index a = half - around + j, b = half - around + (j + 1) % around;
    triangles.push_back({b, a, a + half});
    triangles.push_back({b, a + half, b + half});
  }
  return mesh_of(points, triangles);
}

Mesh leaf(Index columns, Index rows, double thickness) {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;
  std::map<std::array<Index, 3>, Index> number;
  for (const int side : {1, -1}) {
    for (Index i = 0; i <= columns; ++i) {
      for (Index j = 0; j <= rows; ++j) {
        const bool rim = i == 0 || i == columns || j == 0 || j == rows;
        const auto key = std::array<Index, 3>{i, j, rim ? 0 : side};
        if (number.try_emplace(key, static_cast<Index>(points.size())).second) {
          const double x = i - columns / 2.0, y = j - rows / 2.0;
          points.emplace_back(x, y, 0.02 * x * x - 0.01 * y * y + key[2] * thickness / 2);
        }
      }
    }
    const auto at = [&](Index i, Index j) {
      const bool rim = i == 0 || i == columns || j == 0 || j == rows;
      return number.at({i, j, rim ? 0 : side});
    };
    const auto add = [&](Index a, Index b, Index c) {
      triangles.push_back(side > 0 ? Corners{a, b, c} : Corners{a, c, b});
    };
    for (Index i = 0; i < columns; ++i) {
      for (Index j = 0; j < rows; ++j) {
        const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        // No triangle may have its three corners on the rim: both sheets would have it.
        const bool left = i == 0, right = i == columns - 1, low = j == 0, high = j == rows - 1;
        if ((left && high) || (right && low)) {
          add(b, c, d);
          add(b, d, a);
        } else {
          add(a, b, c);
          add(a, c, d);
        }
      }
    }
  }
  return mesh_of(points, triangles);
}

Mesh two_half_balls(Index radius) {
  const auto label = [&](const GridPoints::Place& cell) {
    const Vec3 x = Vec3(cell[0], cell[1], cell[2]).array() + 0.5 - radius;
    return x.norm() > radius ? 0 : x.dot(Vec3(1, -0.3, 0.1)) > 0 ? 1 : 2;
  };
  GridPoints points;
  std::vector<Corners> triangles;
  for (Index i = -1; i <= 2 * radius; ++i) {
    for (Index j = -1; j <= 2 * radius; ++j) {
      for (Index k = -1; k <= 2 * radius; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          GridPoints::Place beside{i, j, k};
          ++beside[axis];
          if (label({i, j, k}) != label(beside)) {
            add_face({i, j, k}, axis, true, points, triangles);
          }
        }
      }
    }
  }
  std::vector<Vec3> positions;
  for (const auto& [i, j, k] : points.places()) {
    positions.push_back(Vec3(i, j, k).array() - radius);
  }
  return mesh_of(positions, triangles);
}

}  // namespace ibmfair::test
