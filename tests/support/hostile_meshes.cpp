#include "support/hostile_meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"

namespace ibmfair::test {
namespace {

using Face = std::array<Index, 3>;

Mesh ball() {
  Mesh mesh = make_shape("icosphere", {.subdivide = 3});
  add_noise(mesh.X, 0.003, 1);
  return mesh;
}

Mesh from(const std::vector<Vec3>& points, const std::vector<Face>& faces) {
  Mesh mesh;
  mesh.X.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.X.row(static_cast<Eigen::Index>(v)) = points[v];
  }
  for (const Face& face : faces) {
    mesh.faces.add(face);
  }
  return mesh;
}

/// The mesh with copies of its first 200 faces, in their own or the opposite orientation.
Mesh with_copies(Mesh mesh, bool turned) {
  for (Index f = 0; f < 200; ++f) {
    Face corners{mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2]};
    if (turned) {
      std::swap(corners[0], corners[1]);
    }
    mesh.faces.add(corners);
  }
  return mesh;
}

/// The mesh with a third triangle at the first edge of every twentieth face.
Mesh with_fins(Mesh mesh) {
  const Index faces = mesh.faces.size();
  for (Index f = 0; f < faces; f += 20) {
    const auto tip = static_cast<Index>(mesh.X.rows());
    mesh.X.conservativeResize(tip + 1, 3);
    mesh.X.row(tip) = 1.5 * mesh.X.row(mesh.faces[f][2]);
    mesh.faces.add(Face{mesh.faces[f][0], mesh.faces[f][1], tip});
  }
  return mesh;
}

Mesh with_isolated_vertices(Mesh mesh) {
  const auto vertices = mesh.X.rows();
  mesh.X.conservativeResize(vertices + 1000, 3);
  mesh.X.bottomRows(1000).setConstant(0.5);
  return mesh;
}

/// Copies of a tetrahedron, apart from each other or with one vertex in common.
Mesh tetrahedra(Index count, bool joined) {
  const std::array<Vec3, 4> corner{Vec3(1, 1, 1), {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::array<Face, 4> faces{Face{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  std::vector<Vec3> points;
  std::vector<Face> all;
  for (Index i = 0; i < count; ++i) {
    const auto first = static_cast<Index>(points.size());
    const Vec3 place = 4 * Vec3(i % 17, i / 17 % 17, i / 289);  // NOLINT: whole numbers are meant
    for (const Vec3& x : corner) {
      points.emplace_back(place + x);
    }
    for (const Face& face : faces) {
      all.push_back({first + face[0], first + face[1], first + face[2]});
      for (Index& v : all.back()) {
        v = joined && v % 4 == 0 ? 0 : v;
      }
    }
  }
  return from(points, all);
}

/// Triangles that all share one edge, all around this edge.
Mesh book(Index pages) {
  std::vector<Vec3> points{{0, 0, 0}, {0, 0, 1}};
  std::vector<Face> faces;
  for (Index i = 0; i < pages; ++i) {
    points.emplace_back(std::cos(i), std::sin(i), 0.5);
    faces.push_back({0, 1, 2 + i});
  }
  return from(points, faces);
}

/// A fan whose faces all meet in one vertex; the ring of this vertex goes up and down.
Mesh fan(Index blades) {
  std::vector<Vec3> points{{0, 0, 0.5}};
  std::vector<Face> faces;
  for (Index i = 0; i < blades; ++i) {
    const double angle = 2 * std::numbers::pi * i / blades;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.01 * std::sin(9 * i));
    faces.push_back({0, 1 + i, 1 + (i + 1) % blades});
  }
  return from(points, faces);
}

Mesh soup(Index vertices, Index faces) {
  std::mt19937 random(1);
  std::vector<Vec3> points;
  for (Index v = 0; v < vertices; ++v) {
    points.emplace_back(random() % 1000, random() % 1000, random() % 1000);
  }
  std::vector<Face> all;
  const auto any = [&] { return static_cast<Index>(random() % vertices); };
  for (Index f = 0; f < faces; ++f) {
    all.push_back({any(), any(), any()});
  }
  return from(points, all);
}

template <class Change>
Mesh changed(Mesh mesh, const Change& change) {
  for (Index v = 0; v < mesh.X.rows(); ++v) {
    Vec3 x = mesh.X.row(v);
    change(v, x);
    mesh.X.row(v) = x;
  }
  return mesh;
}

Mesh scaled(double factor) {
  return changed(ball(), [=](Index /*v*/, Vec3& x) { x *= factor; });
}

Mesh far_off(double distance) {
  return changed(ball(), [=](Index /*v*/, Vec3& x) { x += distance * Vec3(1, 2, -1); });
}

Mesh with_spike(double factor) {
  return changed(ball(), [=](Index v, Vec3& x) { x *= v == 10 ? factor : 1; });
}

/// Cuts face f in three by a new vertex; one of the new faces replaces face f.
void cut_in_three(Mesh& mesh, Index f, const Vec3& x) {
  const auto p = static_cast<Index>(mesh.X.rows());
  mesh.X.conservativeResize(p + 1, 3);
  mesh.X.row(p) = x;
  Index* corner = &mesh.faces.corner[3 * static_cast<std::size_t>(f)];
  mesh.faces.add(Face{corner[0], corner[1], p});
  corner = &mesh.faces.corner[3 * static_cast<std::size_t>(f)];
  mesh.faces.add(Face{corner[0], p, corner[2]});
  mesh.faces.corner[3 * static_cast<std::size_t>(f)] = p;
}

/// A ball with a second vertex close to a corner of every fiftieth face.
Mesh with_close_vertices(double distance) {
  Mesh mesh = ball();
  for (Index f = 0; f < 1280; f += 50) {
    const auto corners = mesh.faces[f];
    const Vec3 a = mesh.X.row(corners[0]), b = mesh.X.row(corners[1]), c = mesh.X.row(corners[2]);
    cut_in_three(mesh, f, a + distance * (b + c - 2 * a));
  }
  return mesh;
}

Mesh named(const std::vector<NamedMesh>& meshes, const std::string& name) {
  for (const NamedMesh& mesh : meshes) {
    if (mesh.name == name) {
      return mesh.mesh;
    }
  }
  return {};
}

}  // namespace

Mesh sheet_with_needles(double degrees, Index every) {
  Mesh mesh = flat_sheet(24, 24);
  std::mt19937 random(1);
  mesh = changed(mesh, [&](Index /*v*/, Vec3& x) {
    x[2] = 0.05 * std::sin(7 * x[0]) * std::cos(5 * x[1]) + 0.005 * (random() % 1000 / 500.0 - 1);
  });
  const Index faces = mesh.faces.size();
  for (Index f = 0; f < faces; f += every) {
    const auto corners = mesh.faces[f];
    const Vec3 a = mesh.X.row(corners[0]), b = mesh.X.row(corners[1]), c = mesh.X.row(corners[2]);
    const Vec3 edge = b - a;
    const Vec3 inward = (c - a) - edge * ((c - a).dot(edge) / edge.squaredNorm());
    const double height = edge.norm() / 2 * std::tan(degrees * std::numbers::pi / 180);
    cut_in_three(mesh, f, (a + b) / 2 + height * inward.normalized());
  }
  return mesh;
}

std::vector<HostileMesh> hostile_meshes() {
  constexpr int incomplete = 1, bad_mesh = 4;
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};
  return {
      {"one triangle", from({corners[0], corners[1], corners[2]}, {{0, 1, 2}}), 0, incomplete},
      {"two triangles", from(corners, {{0, 1, 2}, {1, 3, 2}})},
      {"two opposite faces", from({corners[0], corners[1], corners[2]}, {{0, 1, 2}, {0, 2, 1}})},
      {"two equal faces", from({corners[0], corners[1], corners[2]}, {{0, 1, 2}, {0, 1, 2}})},
      {"nothing but boundary", flat_sheet(1, 40), 0, incomplete},
      {"fan of 200", fan(200)},
      {"fifty triangles at an edge", book(50), 0, incomplete},
      {"hundred tetrahedra at a vertex", tetrahedra(100, true), incomplete},
      {"5000 components", tetrahedra(5000, false)},
      {"soup", soup(300, 800), 0, incomplete},
      {"dense soup with repeated corners", soup(30, 400), 0, incomplete},
      {"duplicate faces", with_copies(ball(), false)},
      {"opposite faces", with_copies(ball(), true)},
      {"fins", with_fins(ball())},
      {"isolated vertices", with_isolated_vertices(ball())},
      {"Moebius strip", named(nonorientable_meshes(), "Moebius strip"), 0, incomplete},
      {"Klein bottle", named(nonorientable_meshes(), "Klein bottle")},
      {"all vertices in one place", changed(ball(), [](Index, Vec3& x) { x.setOnes(); }), bad_mesh},
      {"fifty vertices in one place",
       changed(ball(), [](Index v, Vec3& x) { x = v < 50 ? Vec3(Vec3::UnitX()) : x; })},
      {"flattened", changed(ball(), [](Index, Vec3& x) { x[2] = 0; })},
      {"on a line", changed(ball(), [](Index, Vec3& x) { x[1] = x[2] = 0; })},
      {"every third vertex turned inside out",
       changed(ball(), [](Index v, Vec3& x) { x *= v % 3 == 0 ? -1 : 1; })},
      {"scaled by 1e-30", scaled(1e-30)},
      {"scaled by 1e30", scaled(1e30)},
      {"scaled by 1e-150", scaled(1e-150), bad_mesh},
      {"scaled by 1e100", scaled(1e100), bad_mesh},
      {"scaled by 1e300", scaled(1e300), bad_mesh},
      {"1e9 from the origin", far_off(1e9)},
      {"1e16 from the origin, where all vertices coincide", far_off(1e16)},
      {"spike of 1e4", with_spike(1e4)},
      {"spike of 1e200", with_spike(1e200), bad_mesh},
      {"vertices 1e-5 apart", with_close_vertices(1e-5)},
      {"vertices 1e-9 apart", with_close_vertices(1e-9)},
      {"vertices 1e-13 apart", with_close_vertices(1e-13)},
      {"graded from 1 to 1e5",
       changed(ball(), [](Index, Vec3& x) { x *= std::exp(12 * std::abs(x[2])); })},
  };
}

}  // namespace ibmfair::test
