// The measures of meshes agree with known surfaces, whatever the scale and place.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/measure/closest_point.h"
#include "ibmfair/measure/directed_distance.h"
#include "ibmfair/measure/exact_surface.h"
#include "ibmfair/measure/matching_meshes.h"
#include "ibmfair/measure/mesh_summary.h"
#include "ibmfair/measure/sphere_fit.h"
#include "ibmfair/measure/surface_deviation.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/grids.h"
#include "ibmfair/shapes/polyhedra.h"
#include "support/meshes.h"

namespace ibmfair {
namespace {

using std::numbers::pi;

MeshSummary summary_of(const Mesh& mesh) {
  return summarise(mesh, build_topology(mesh.X, triangulate(mesh).F));
}

double size_of(const Points& X) {
  return bounding_box_size(X).norm();
}

TEST(MeshSummary, ScalesAndMovesWithTheMesh) {
  for (const auto& [name, mesh] : test::all_meshes()) {
    SCOPED_TRACE(name);
    const MeshSummary before = summary_of(mesh);
    for (const double scale : {1e-8, 1.0, 1e8}) {
      const MeshSummary after = summary_of(test::moved(mesh, scale, scale * Vec3(3, -1, 2)));
      EXPECT_EQ(after.genus, before.genus);
      EXPECT_EQ(after.closed, before.closed);
      EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
      EXPECT_EQ(after.boundary_loops, before.boundary_loops);
      EXPECT_NEAR(after.mean_edge, scale * before.mean_edge, 1e-12 * scale * before.mean_edge);
      EXPECT_NEAR(after.area, scale * scale * before.area, 1e-12 * scale * scale * before.area);
      EXPECT_NEAR(after.smallest_angle, before.smallest_angle, 1e-6);
      ASSERT_EQ(after.volume.has_value(), before.volume.has_value());
      if (before.volume) {
        const double volume = std::pow(scale, 3.0) * *before.volume;
        EXPECT_NEAR(*after.volume, volume, 1e-10 * std::abs(volume));
        EXPECT_GT(*after.volume, 0.0);
      }
    }
  }
}

TEST(MeshSummary, KnowsTheTopologyOfEachClass) {
  for (const auto& [name, mesh] : test::closed_meshes()) {
    SCOPED_TRACE(name);
    const MeshSummary summary = summary_of(mesh);
    EXPECT_TRUE(summary.closed);
    EXPECT_EQ(summary.genus, name == "torus" ? 1 : 0);
    EXPECT_EQ(summary.components, name == "two spheres" ? 2 : 1);
    EXPECT_EQ(summary.hinges, summary.edges);
    EXPECT_TRUE(summary.volume);
  }
  for (const auto& [name, mesh] : test::open_meshes()) {
    SCOPED_TRACE(name);
    const MeshSummary summary = summary_of(mesh);
    EXPECT_FALSE(summary.closed);
    EXPECT_EQ(summary.genus, 0);
    EXPECT_EQ(summary.boundary_loops, name == "annulus" || name == "open cylinder" ? 2 : 1);
    EXPECT_FALSE(summary.volume);
  }
  for (const auto& [name, mesh] : test::nonorientable_meshes()) {
    SCOPED_TRACE(name);
    EXPECT_FALSE(summary_of(mesh).orientable);
    EXPECT_FALSE(summary_of(mesh).genus);
    EXPECT_FALSE(summary_of(mesh).volume);
  }
}

TEST(MeshSummary, DoesNotDependOnOrientationExceptForTurnedTriangles) {
  for (const auto& [name, mesh] : test::good_meshes()) {
    SCOPED_TRACE(name);
    const Mesh mixed = test::with_mixed_orientation(mesh);
    const MeshSummary before = summary_of(mesh);
    const MeshSummary after = summary_of(mixed);
    EXPECT_EQ(before.turned_triangles, 0);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
    if (before.volume && before.components == 1) {
      EXPECT_NEAR(std::abs(*after.volume), *before.volume, 1e-12 * *before.volume);
    }
  }
}

TEST(SphereFit, FindsTheSphereOfPointsOnOneAtAnyPlaceAndScale) {
  for (const double scale : {1e-8, 1.0, 1e8}) {
    for (const Vec3& center : {Vec3(0, 0, 0), Vec3(3, -2, 100)}) {
      // A cap is enough: the points need not cover the whole sphere.
      const Points all = make_icosphere({3}).X;
      for (const Eigen::Index count : {Eigen::Index{12}, all.rows() / 2, all.rows()}) {
        Points X = 2.5 * scale * all.topRows(count);
        X.rowwise() += scale * center.transpose();
        const SphereFit fit = fit_sphere(X);
        EXPECT_NEAR(fit.radius, 2.5 * scale, 1e-12 * scale);
        EXPECT_LE((fit.center - scale * center).norm(), 1e-11 * scale);
        EXPECT_LE(fit.deviation, 1e-13 * (1.0 + center.norm()));
      }
    }
  }
}

// For every centre near the fitted centre, the variance of the distances is larger.
TEST(SphereFit, IsALocalMinimum) {
  for (const auto& [name, mesh] : test::good_meshes()) {
    if (name == "triangle" || name == "annulus" || name == "quadrilateral square") {
      EXPECT_THROW(fit_sphere(mesh.X), BadMesh) << name;  // flat or too few points
      continue;
    }
    SCOPED_TRACE(name);
    const SphereFit fit = fit_sphere(mesh.X);
    const auto variance = [&X = mesh.X](const Vec3& center) {
      const Eigen::VectorXd d = (X.rowwise() - center.transpose()).rowwise().norm();
      return (d.array() - d.mean()).square().mean();
    };
    const double best = variance(fit.center);
    EXPECT_NEAR(std::sqrt(best) / fit.radius, fit.deviation, 1e-9);
    RandomNumbers random(5);
    for (int i = 0; i < 20; ++i) {
      const Vec3 step(random.normal(), random.normal(), random.normal());
      EXPECT_GE(variance(fit.center + 1e-3 * size_of(mesh.X) * step), best * (1.0 - 1e-12));
    }
  }
}

TEST(SphereFit, RefusesPointsThatNoSphereFits) {
  EXPECT_THROW(fit_sphere(Points::Zero(10, 3)), BadMesh);
  EXPECT_THROW(fit_sphere(make_plane(1.0, {}).X), BadMesh);
  EXPECT_THROW(fit_sphere(Points::Random(3, 3)), BadMesh);
}

TEST(ExactSurface, DistancesAndNormalsAreThoseOfTheSurface) {
  const Vec3 center(0.3, -0.2, 0.1);
  const ExactSphere sphere(center, 2.0);
  const ExactTorus torus(center, 1.0, 0.4);
  RandomNumbers random(3);
  for (const ExactSurface* surface :
       {static_cast<const ExactSurface*>(&sphere), static_cast<const ExactSurface*>(&torus)}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = Vec3(random.normal(), random.normal(), random.normal());
      const Vec3 n = surface->normal(x);
      EXPECT_NEAR(n.norm(), 1.0, 1e-14);
      EXPECT_NEAR(surface->signed_distance(x - surface->signed_distance(x) * n), 0.0, 1e-13);
    }
  }
  EXPECT_NEAR(torus.signed_distance(center + Vec3(1.4, 0, 0)), 0.0, 1e-15);
  EXPECT_NEAR(torus.signed_distance(center + Vec3(0, -0.6, 0)), 0.0, 1e-15);
  EXPECT_NEAR(torus.signed_distance(center + Vec3(0, 1.0, 0.5)), 0.1, 1e-15);
  EXPECT_LT(sphere.signed_distance(center), 0.0);
  EXPECT_THROW(ExactSphere(center, 0.0), BadOption);
  EXPECT_THROW(ExactTorus(center, 1.0, 1.0), BadOption);
}

TEST(SurfaceDeviation, IsZeroOnTheSurfaceAndCountsFlippedTriangles) {
  const ExactTorus torus(Vec3::Zero(), 1.0, 0.4);
  TriangleMesh mesh = make_torus(2.5, {40, 100});
  SurfaceDeviation deviation = deviation_from(torus, mesh.X, mesh.F);
  EXPECT_LE(deviation.distance.max, 1e-15);
  EXPECT_LT(deviation.angles.degrees.max, 10.0);
  EXPECT_EQ(deviation.angles.flipped, 0);

  mesh.F.row(17).reverseInPlace();
  mesh.X.row(1234) *= 1.01;
  deviation = deviation_from(torus, mesh.X, mesh.F);
  EXPECT_EQ(deviation.angles.flipped, 1);
  EXPECT_EQ(deviation.angles.degrees.where, 17);
  EXPECT_EQ(deviation.distance.where, 1234);
}

TEST(SurfaceDeviation, NormalErrorFallsWithTheEdgeLength) {
  const ExactSphere sphere(Vec3::Zero(), 1.0);
  double last = 0.0;
  for (int level = 2; level <= 5; ++level) {
    const TriangleMesh mesh = make_icosphere({level});
    const double angle = deviation_from(sphere, mesh.X, mesh.F).angles.degrees.mean;
    if (level > 2) {
      // The normal at the centroid has a second-order error on near-equilateral triangles.
      EXPECT_GT(last / angle, 1.9);
    }
    last = angle;
  }
}

// The closest point is compared with points on all triangles, and must itself be a point of the
// surface.
TEST(ClosestPoint, IsNoFartherThanAnyPointOfTheSurface) {
  RandomNumbers random(11);
  for (const auto& [name, mesh] : test::at_all_scales(test::all_meshes())) {
    SCOPED_TRACE(name);
    const Triangles F = triangulate(mesh).F;
    const ClosestPoint closest(mesh.X, F);
    const double size = size_of(mesh.X);
    const double rounding = 1e-12 * size + 1e-14 * mesh.X.cwiseAbs().maxCoeff();
    const Vec3 middle = mesh.X.colwise().mean();
    for (int i = 0; i < 5; ++i) {
      const Vec3 x = middle + 0.5 * size * Vec3(random.normal(), random.normal(), random.normal());
      const ClosestPoint::Hit hit = closest(x);
      EXPECT_NEAR((x - hit.point).norm(), hit.distance, rounding);
      double nearest = std::numeric_limits<double>::infinity();
      for (Eigen::Index f = 0; f < F.rows(); ++f) {
        for (const Vec3& b :
             {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 0), Vec3(0.2, 0.3, 0.5)}) {
          const Vec3 y =
              b[0] * mesh.X.row(F(f, 0)) + b[1] * mesh.X.row(F(f, 1)) + b[2] * mesh.X.row(F(f, 2));
          nearest = std::min(nearest, (x - y).norm());
        }
      }
      EXPECT_LE(hit.distance, nearest + rounding);
      // The closest point lies on the triangle that the result names.
      EXPECT_LE(ClosestPoint(mesh.X, F.row(hit.triangle))(hit.point).distance, rounding);
    }
  }
}

TEST(ClosestPoint, OfAPointOnTheSurfaceIsItself) {
  for (const auto& [name, mesh] : test::at_all_scales(test::all_meshes())) {
    SCOPED_TRACE(name);
    const Triangles F = triangulate(mesh).F;
    const ClosestPoint closest(mesh.X, F);
    const double rounding = 1e-12 * size_of(mesh.X) + 1e-14 * mesh.X.cwiseAbs().maxCoeff();
    for (Eigen::Index f = 0; f < F.rows(); f += 7) {
      const Vec3 x = (mesh.X.row(F(f, 0)) + mesh.X.row(F(f, 1)) + 2.0 * mesh.X.row(F(f, 2))) / 4.0;
      EXPECT_LE(closest(x).distance, rounding);
    }
  }
}

TEST(ClosestPoint, NeedsASurface) {
  Points X(3, 3);
  X << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  Triangles F(1, 3);
  F << 0, 1, 2;
  EXPECT_THROW(ClosestPoint(X, F), BadMesh);
  EXPECT_THROW(ClosestPoint(X, Triangles(0, 3)), BadMesh);
}

TEST(DirectedDistance, OfASurfaceToItselfIsRounding) {
  for (const auto& [name, mesh] : test::at_all_scales(test::all_meshes())) {
    SCOPED_TRACE(name);
    const Triangles F = triangulate(mesh).F;
    const DirectedDistance d = directed_distance(mesh.X, F, mesh.X, F, 500);
    const double rounding = 1e-12 * size_of(mesh.X) + 1e-14 * mesh.X.cwiseAbs().maxCoeff();
    EXPECT_LE(d.max, rounding);
    EXPECT_LE(d.rms, d.max);
    EXPECT_LE(d.mean, d.rms * (1.0 + 1e-12));
  }
}

TEST(DirectedDistance, KnowsParallelSurfacesAndIsNotSymmetric) {
  const TriangleMesh a = make_plane(1.0, {{}, 9});
  TriangleMesh b = make_plane(1.0, {{}, 14});
  b.X.col(2).array() += 0.25;
  const DirectedDistance d = directed_distance(a.X, a.F, b.X, b.F, 1000);
  EXPECT_NEAR(d.mean, 0.25, 1e-15);
  EXPECT_NEAR(d.rms, 0.25, 1e-15);
  EXPECT_NEAR(d.max, 0.25, 1e-15);
  EXPECT_NEAR(d.angles.degrees.max, 0.0, 1e-12);

  // A square lies inside a square of twice the side. No point of the small square is far from the
  // large square, but a corner of the large square is far from the small square.
  TriangleMesh large = a;
  large.X *= 2.0;
  EXPECT_NEAR(directed_distance(a.X, a.F, large.X, large.F, 100).max, 0.0, 1e-15);
  const DirectedDistance back = directed_distance(large.X, large.F, a.X, a.F, 50000);
  EXPECT_NEAR(back.max, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR((back.farthest - Vec3(2, 2, 0)).norm(), 0.0, 1e-12);
  // The mean over [0,2]^2: two strips with a mean of 1/2, and a square whose mean is the mean of
  // |x| over [0,1]^2.
  const double corner = (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 3.0;
  EXPECT_NEAR(back.mean, (0.0 + 0.5 + 0.5 + corner) / 4.0, 2e-3);
  EXPECT_NEAR(back.rms, std::sqrt((1.0 / 3.0 + 1.0 / 3.0 + 2.0 / 3.0) / 4.0), 2e-3);
}

TEST(MatchingMeshes, MeasureWhatWasMoved) {
  for (const auto& [name, mesh] : test::all_meshes()) {
    SCOPED_TRACE(name);
    Mesh other = mesh;
    ASSERT_TRUE(same_connectivity(mesh, other));
    EXPECT_EQ(vertex_differences(mesh.X, other.X).max, 0.0);
    EXPECT_EQ(face_normal_angles(mesh, other).degrees.max, 0.0);

    const auto v = static_cast<Index>(mesh.X.rows() / 2);
    other.X.row(v) += Eigen::RowVector3d(0.3, 0.0, -0.4);
    const Statistics moved = vertex_differences(mesh.X, other.X);
    EXPECT_NEAR(moved.max, 0.5, 1e-12);
    EXPECT_EQ(moved.where, v);
    EXPECT_NEAR(moved.mean, 0.5 / mesh.X.rows(), 1e-12);
    EXPECT_NEAR(moved.rms, 0.5 / std::sqrt(mesh.X.rows()), 1e-12);

    const Mesh turned = test::moved(mesh, 2.0, Vec3(1, 2, 3), 0.25);
    EXPECT_LE(face_normal_angles(mesh, turned).degrees.max, 0.25 * 180.0 / pi + 1e-9);
    EXPECT_GT(face_normal_angles(mesh, turned).degrees.max, 0.0);

    other.faces.corner.front() =
        (other.faces.corner.front() + 1) % static_cast<Index>(mesh.X.rows());
    EXPECT_FALSE(same_connectivity(mesh, other));
  }
}

TEST(NormalAngles, AreExactWhereTheCosineIsNot) {
  EXPECT_NEAR(degrees_between({1, 0, 0}, {1, 1e-9, 0}), 1e-9 * 180.0 / pi, 1e-18);
  EXPECT_NEAR(degrees_between({1e-200, 0, 0}, {0, 1e200, 0}), 90.0, 1e-12);
  EXPECT_NEAR(degrees_between({1, 0, 0}, {-1, 0, 0}), 180.0, 1e-12);
  EXPECT_TRUE(std::isnan(degrees_between({0, 0, 0}, {1, 0, 0})));
  Eigen::VectorXd degrees(4);
  degrees << 10.0, std::nan(""), 120.0, 20.0;
  const NormalAngles angles = summarise_angles(degrees);
  EXPECT_EQ(angles.left_out, 1);
  EXPECT_EQ(angles.flipped, 1);
  EXPECT_EQ(angles.degrees.where, 2);
  EXPECT_NEAR(angles.degrees.mean, 50.0, 1e-12);
}

TEST(Statistics, AreSafeForTheSmallestLargestAndNotANumber) {
  EXPECT_EQ(summarise(Eigen::VectorXd()).where, -1);
  for (const double scale : {1e-200, 1.0, 1e200}) {
    Eigen::VectorXd values(2);
    values << 3.0 * scale, 4.0 * scale;
    EXPECT_NEAR(summarise(values).rms / scale, std::sqrt(12.5), 1e-12);
  }
  Eigen::VectorXd values(3);
  values << 1.0, std::nan(""), 2.0;
  EXPECT_EQ(summarise(values).max, std::numeric_limits<double>::infinity());
  EXPECT_EQ(summarise(values).where, 1);
}

}  // namespace
}  // namespace ibmfair
