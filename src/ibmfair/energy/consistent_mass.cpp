#include "ibmfair/energy/consistent_mass.h"

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr int chebyshev_sweeps = 35;  // 2 * 3^-35 = 4e-17
constexpr double smallest_eigenvalue = 0.25, largest_eigenvalue = 1;

Vec3 mass_times(const VertexTriangles& triangles, Index v, const Points& Y) {
  Vec3 sum = Vec3::Zero();
  triangles.around(v, [&](Index t, int i) {
    const auto x = triangles.corners().row(t);
    const double area = triangles.shapes()[t].area;
    sum += area / 12 * (2 * Y.row(x[i]) + Y.row(x[next(i)]) + Y.row(x[previous(i)]));
  });
  return sum;
}

}  // namespace

void solve_consistent_mass(const VertexTriangles& triangles, std::span<const Index> U,
                           const PerVertex& lumped, const Points& H, Points& Y) {
  constexpr double centre = (largest_eigenvalue + smallest_eigenvalue) / 2;
  constexpr double radius = (largest_eigenvalue - smallest_eigenvalue) / 2;
  const auto count = static_cast<std::int64_t>(U.size());
  Points step = Points::Zero(H.rows(), 3), residual(count, 3);
  parallel_for(count, [&](std::int64_t u) {
    residual.row(u) = H.row(U[u]) / lumped[U[u]];
    step.row(U[u]) = residual.row(u) / centre;
    Y.row(U[u]).setZero();
  });
  double rho = radius / centre;
  for (int sweep = 0; sweep < chebyshev_sweeps; ++sweep) {
    parallel_for(count, [&](std::int64_t u) {
      Y.row(U[u]) += step.row(U[u]);
      residual.row(u) -= mass_times(triangles, U[u], step).transpose() / lumped[U[u]];
    });
    const double next_rho = 1 / (2 * centre / radius - rho);
    parallel_for(count, [&](std::int64_t u) {
      step.row(U[u]) = next_rho * rho * step.row(U[u]) + 2 * next_rho / radius * residual.row(u);
    });
    rho = next_rho;
  }
}

double consistent_mass_slope(const Vec3& y0, const Vec3& y1, const Vec3& y2) {
  return ((y0 + y1 + y2).squaredNorm() + y0.squaredNorm() + y1.squaredNorm() + y2.squaredNorm()) /
         24;
}

}  // namespace ibmfair
