#include "support/creased_meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ibmfair/shapes/shapes.h"
#include "support/holed_meshes.h"
#include "support/states.h"

namespace ibmfair::test {

Mesh cube(int level) {
  ShapeSettings settings;
  settings.subdivide = level;
  return make_shape("cube", settings);
}

Mesh turned(const std::vector<std::array<double, 2>>& profile, Index around) {
  const auto rings = static_cast<Index>(profile.size()) - 2;
  Mesh mesh;
  mesh.X.resize(rings * around + 2, 3);
  for (Index ring = 0; ring < rings; ++ring) {
    const auto [r, z] = profile[ring + 1];
    for (Index i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / around;
      mesh.X.row(ring * around + i) << r * std::cos(angle), r * std::sin(angle), z;
    }
  }
  const Index bottom = rings * around, top = bottom + 1;
  mesh.X.row(bottom) << 0, 0, profile.front()[1];
  mesh.X.row(top) << 0, 0, profile.back()[1];
  const auto add = [&](Index a, Index b, Index c) {
    const std::array<Index, 3> corners{a, b, c};
    mesh.faces.add(corners);
  };
  for (Index i = 0; i < around; ++i) {
    const Index j = (i + 1) % around;
    add(bottom, j, i);
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      const Index a = ring * around + i, b = ring * around + j, c = a + around, d = b + around;
      if (ring % 2 == 0) {
        add(a, b, c);
        add(b, d, c);
      } else {
        add(a, b, d);
        add(a, d, c);
      }
    }
    add((rings - 1) * around + i, (rings - 1) * around + j, top);
  }
  return mesh;
}

namespace {

/// Appends points between the last point and `end`, which is included, at distances of about
/// `step`.
void go_to(std::vector<std::array<double, 2>>& profile, std::array<double, 2> end, double step) {
  const std::array<double, 2> start = profile.back();
  const int n = std::max(
      1, static_cast<int>(std::lround(std::hypot(end[0] - start[0], end[1] - start[1]) / step)));
  for (int i = 1; i <= n; ++i) {
    const double part = static_cast<double>(i) / n;
    profile.push_back(
        {start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])});
  }
}

}  // namespace

Mesh closed_cylinder(Index around) {
  const double step = 2 * std::numbers::pi / around;
  std::vector<std::array<double, 2>> profile{{0, 0}};
  go_to(profile, {1, 0}, step);
  go_to(profile, {1, 1}, step);
  go_to(profile, {0, 1}, step);
  return turned(profile, around);
}

Mesh closed_cone(Index around) {
  const double step = 2 * std::numbers::pi / around;
  std::vector<std::array<double, 2>> profile{{0, 0}};
  go_to(profile, {1, 0}, step);
  go_to(profile, {0, 1}, step);
  return turned(profile, around);
}

Mesh without_rings(const Mesh& mesh, const Vec3& place, int rings) {
  const State state(in_triangles(mesh));
  Index middle = 0;
  (state.X.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&middle);
  const std::vector<std::uint8_t> near = around(state.topology, {middle}, rings - 1);
  std::vector<Index> gone;
  for (Index t = 0; t < state.topology.F.rows(); ++t) {
    const auto corners = state.topology.F.row(t);
    if (std::ranges::any_of(corners, [&](Index v) { return near[v] != 0; })) {
      gone.push_back(t);
    }
  }
  return without_triangles(in_triangles(mesh), gone);
}

}  // namespace ibmfair::test
