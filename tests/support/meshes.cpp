#include "support/meshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

namespace ibmfair::test {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

Mesh make(std::initializer_list<Vec3> points,
          std::initializer_list<std::initializer_list<Index>> faces) {
  Mesh mesh;
  mesh.X.resize(static_cast<Index>(points.size()), 3);
  Index row = 0;
  for (const Vec3& p : points) {
    mesh.X.row(row++) = p;
  }
  for (const auto& face : faces) {
    mesh.faces.add({face.begin(), face.size()});
  }
  return mesh;
}

void add_quad(Mesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.faces.add(std::array{a, b, c});
  mesh.faces.add(std::array{a, c, d});
}

enum class Seam { open, joined, joined_mirrored };

// The image of a grid of columns x rows cells; opposite sides of the grid may be joined. `mirrored`
// joins the last column to the first column upside down, as in a Moebius strip.
Mesh make_grid(Index columns, Index rows, Seam across, Seam along,
               const std::function<Vec3(double u, double v)>& position) {
  const Index width = across == Seam::open ? columns + 1 : columns;
  const Index height = along == Seam::open ? rows + 1 : rows;
  Mesh mesh;
  mesh.X.resize(Eigen::Index{width} * height, 3);
  for (Index j = 0; j < height; ++j) {
    for (Index i = 0; i < width; ++i) {
      mesh.X.row(j * width + i) =
          position(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
    }
  }
  const auto vertex = [&](Index i, Index j) {
    if (across == Seam::joined_mirrored && i == columns) {
      return (along == Seam::open ? rows - j : (rows - j) % rows) * width;
    }
    return (j % height) * width + i % width;
  };
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < columns; ++i) {
      add_quad(mesh, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

Mesh join(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto shift = static_cast<Index>(a.X.rows());
  mesh.X.conservativeResize(a.X.rows() + b.X.rows(), 3);
  mesh.X.bottomRows(b.X.rows()) = b.X;
  for (Index f = 0; f < b.faces.size(); ++f) {
    std::vector<Index> corners(b.faces[f].begin(), b.faces[f].end());
    for (Index& corner : corners) {
      corner += shift;
    }
    mesh.faces.add(corners);
  }
  return mesh;
}

Mesh octahedron() {
  return make(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

Mesh cube() {
  return make(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

// A sphere by longitude and latitude. A wave on the sphere breaks its symmetry, which could hide a
// mistake.
Mesh bumpy_sphere(double radius, double bump) {
  constexpr Index meridians = 16;
  constexpr Index parallels = 9;
  const auto place = [&](double u, double v) {
    const double longitude = two_pi * u;
    const double latitude = std::numbers::pi * (v - 0.5);
    const double r = radius * (1.0 + bump * std::sin(3.0 * longitude + 1.0) * std::cos(latitude) +
                               bump * std::sin(4.0 * latitude));
    return Vec3(r * Vec3(std::cos(latitude) * std::cos(longitude),
                         std::cos(latitude) * std::sin(longitude), std::sin(latitude)));
  };
  Mesh mesh = make_grid(
      meridians, parallels - 1, Seam::joined, Seam::open,
      [&](double u, double v) { return place(u, (1.0 + v * (parallels - 1)) / (parallels + 1)); });
  const auto south = static_cast<Index>(mesh.X.rows());
  const Index north = south + 1;
  mesh.X.conservativeResize(south + 2, 3);
  mesh.X.row(south) = place(0.0, 0.0);
  mesh.X.row(north) = place(0.0, 1.0);
  const Index top = (parallels - 1) * meridians;
  for (Index i = 0; i < meridians; ++i) {
    const Index next = (i + 1) % meridians;
    mesh.faces.add(std::array{south, next, i});
    mesh.faces.add(std::array{north, top + i, top + next});
  }
  return mesh;
}

Mesh torus() {
  return make_grid(24, 12, Seam::joined, Seam::joined, [](double u, double v) {
    const double around = 2.0 + std::cos(two_pi * v);
    return Vec3(around * std::cos(two_pi * u), around * std::sin(two_pi * u), std::sin(two_pi * v));
  });
}

Mesh bumpy_sheet() {
  return make_grid(12, 9, Seam::open, Seam::open, [](double u, double v) {
    return Vec3(u + 0.02 * std::sin(17.0 * v), v,
                0.1 * std::sin(5.0 * u) * std::cos(4.0 * v + 1.0));
  });
}

Mesh annulus() {
  return make_grid(20, 4, Seam::joined, Seam::open, [](double u, double v) {
    return Vec3((2.0 - v) * std::cos(two_pi * u), (2.0 - v) * std::sin(two_pi * u), 0.0);
  });
}

Mesh cylinder() {
  return make_grid(18, 6, Seam::joined, Seam::open, [](double u, double v) {
    return Vec3(std::cos(two_pi * u), std::sin(two_pi * u), 2.0 * v);
  });
}

Mesh quad_square() {
  Mesh mesh;
  mesh.X = flat_sheet(4, 4).X;
  for (Index j = 0; j < 4; ++j) {
    for (Index i = 0; i < 4; ++i) {
      const Index a = j * 5 + i;
      mesh.faces.add(std::array<Index, 4>{a, a + 1, a + 6, a + 5});
    }
  }
  return mesh;
}

Mesh moebius_strip() {
  return make_grid(24, 4, Seam::joined_mirrored, Seam::open, [](double u, double v) {
    const double half = 0.5 * two_pi * u;
    const double across = v - 0.5;
    const double r = 2.0 + across * std::cos(half);
    return Vec3(r * std::cos(two_pi * u), r * std::sin(two_pi * u), across * std::sin(half));
  });
}

Mesh klein_bottle() {
  return make_grid(24, 12, Seam::joined_mirrored, Seam::joined, [](double u, double v) {
    const double half = 0.5 * two_pi * u;
    const double a = std::sin(two_pi * v);
    const double b = std::sin(2.0 * two_pi * v);
    const double r = 3.0 + std::cos(half) * a - std::sin(half) * b;
    return Vec3(r * std::cos(two_pi * u), r * std::sin(two_pi * u),
                std::sin(half) * a + std::cos(half) * b);
  });
}

}  // namespace

std::vector<NamedMesh> closed_meshes() {
  return {
      {"tetrahedron", make({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                           {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})},
      {"octahedron", octahedron()},
      {"quadrilateral cube", cube()},
      {"bumpy sphere", bumpy_sphere(1.0, 0.1)},
      {"torus", torus()},
      {"two spheres", join(bumpy_sphere(1.0, 0.0), moved(bumpy_sphere(0.3, 0.1), 1.0, {4, 1, 0}))}};
}

std::vector<NamedMesh> open_meshes() {
  return {
      {"triangle", make({{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0.2}}, {{0, 1, 2}})},
      {"quadrilateral square", quad_square()},
      {"bumpy sheet", bumpy_sheet()},
      {"annulus", annulus()},
      {"open cylinder", cylinder()},
      {"sheet beside sphere", join(bumpy_sheet(), moved(bumpy_sphere(1.0, 0.1), 1.0, {0, 0, 3}))}};
}

std::vector<NamedMesh> good_meshes() {
  std::vector<NamedMesh> meshes = closed_meshes();
  for (NamedMesh& mesh : open_meshes()) {
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<NamedMesh> nonorientable_meshes() {
  return {{"Moebius strip", moebius_strip()}, {"Klein bottle", klein_bottle()}};
}

std::vector<NamedMesh> defective_meshes() {
  const Mesh sheet = bumpy_sheet();

  // Two copies of the sheet that share only one corner.
  Mesh bow_tie = join(sheet, moved(sheet, 1.0, {3, 0, 0}, 0.0));
  const auto second = static_cast<Index>(sheet.X.rows());
  for (Index& corner : bow_tie.faces.corner) {
    corner = corner == second ? second - 1 : corner;
  }

  // A fin on an interior edge of the sheet.
  Mesh fin = sheet;
  const auto tip = static_cast<Index>(fin.X.rows());
  fin.X.conservativeResize(tip + 1, 3);
  fin.X.row(tip) = Vec3(0.5, 0.5, 1.0);
  fin.faces.add(std::array<Index, 3>{54, 55, tip});

  // One side of an interior edge gets the edge's midpoint as a corner; a triangle without area
  // closes the gap to the other side.
  const Mesh flat = flat_sheet(6, 6);
  Mesh needle;
  const auto middle = static_cast<Index>(flat.X.rows());
  needle.X.resize(middle + 1, 3);
  needle.X.topRows(middle) = flat.X;
  needle.X.row(middle) = 0.5 * (flat.X.row(24) + flat.X.row(25));
  for (Index f = 0; f < flat.faces.size(); ++f) {
    const std::span<const Index> corners = flat.faces[f];
    if (corners[0] == 24 && corners[1] == 25) {
      needle.faces.add(std::array{corners[0], middle, corners[2]});
      needle.faces.add(std::array{middle, corners[1], corners[2]});
      needle.faces.add(std::array{corners[0], corners[1], middle});
    } else {
      needle.faces.add(corners);
    }
  }

  Mesh repeated = sheet;
  repeated.faces.add(std::array<Index, 3>{40, 41, 40});

  Mesh duplicate = sheet;
  duplicate.faces.add(std::array{sheet.faces[50][1], sheet.faces[50][2], sheet.faces[50][0]});

  Mesh isolated = sheet;
  isolated.X.conservativeResize(sheet.X.rows() + 1, 3);
  isolated.X.row(sheet.X.rows()) = Vec3(7.0, 7.0, 7.0);

  return {{"bow tie", bow_tie},          {"non-manifold edge", fin},
          {"zero area", needle},         {"repeated corner", repeated},
          {"duplicate face", duplicate}, {"isolated vertex", isolated}};
}

std::vector<NamedMesh> all_meshes() {
  std::vector<NamedMesh> meshes = good_meshes();
  for (auto* more : {&nonorientable_meshes, &defective_meshes}) {
    for (NamedMesh& mesh : more()) {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

std::vector<NamedMesh> placed(const std::vector<NamedMesh>& meshes, Placement placement) {
  std::vector<NamedMesh> result;
  for (const auto& [name, mesh] : meshes) {
    const double size = (mesh.X.colwise().maxCoeff() - mesh.X.colwise().minCoeff()).norm();
    switch (placement) {
      case Placement::as_is:
        result.push_back({name, mesh});
        break;
      case Placement::tiny:
        result.push_back({name + " scaled by 1e-8", moved(mesh, 1e-8, Vec3::Zero())});
        break;
      case Placement::huge:
        result.push_back({name + " scaled by 1e8", moved(mesh, 1e8, Vec3::Zero())});
        break;
      case Placement::far_away:
        result.push_back({name + " far away", moved(mesh, 1.0, 1e5 * size * Vec3(1.0, -2.0, 0.5))});
        break;
    }
  }
  return result;
}

std::vector<NamedMesh> at_all_scales(const std::vector<NamedMesh>& meshes) {
  std::vector<NamedMesh> result;
  for (const Placement placement : all_placements) {
    for (NamedMesh& mesh : placed(meshes, placement)) {
      result.push_back(std::move(mesh));
    }
  }
  return result;
}

Mesh flat_sheet(Index columns, Index rows) {
  return make_grid(columns, rows, Seam::open, Seam::open,
                   [](double u, double v) { return Vec3(u, v, 0.0); });
}

Mesh barrel(Index around) {
  Mesh mesh;
  mesh.X.resize(2 * around + 2, 3);
  const Index north = 2 * around, south = north + 1;
  mesh.X.row(north) = Vec3(0, 0, 2);
  mesh.X.row(south) = Vec3(0, 0, -2);
  for (Index i = 0; i < around; ++i) {
    const double angle = two_pi * i / around;
    mesh.X.row(i) = Vec3(std::cos(angle), std::sin(angle), 1);
    mesh.X.row(around + i) = Vec3(std::cos(angle), std::sin(angle), -1);
    const Index next = (i + 1) % around;
    mesh.faces.add(std::array{north, i, next});
    mesh.faces.add(std::array{i, around + i, next});
    mesh.faces.add(std::array{next, around + i, around + next});
    mesh.faces.add(std::array{south, around + next, around + i});
  }
  return mesh;
}

Mesh with_mixed_orientation(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  Mesh result;
  result.X = mesh.X;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const std::span<const Index> corners = mesh.faces[f];
    if (random() % 2 == 0) {
      result.faces.add(corners);
    } else {
      result.faces.add(std::vector<Index>(corners.rbegin(), corners.rend()));
    }
  }
  return result;
}

Mesh moved(const Mesh& mesh, double scale, const Vec3& offset, double angle) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(angle, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  Mesh result = mesh;
  result.X = scale * mesh.X * R.transpose();
  result.X.rowwise() += offset.transpose();
  return result;
}

}  // namespace ibmfair::test
