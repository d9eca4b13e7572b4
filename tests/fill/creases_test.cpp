// The curves that continue creases, and what a patch between creases takes from the mesh.
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/angle.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/fill/crease_curves.h"
#include "ibmfair/fill/fill_holes.h"
#include "ibmfair/fill/sharp_lines.h"
#include "ibmfair/mesh/geometry.h"
#include "support/creased_meshes.h"
#include "support/holed_meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// A circle of any size in any place, by its angle.
struct SomeCircle {
  Vec3 center;
  double radius;
  Eigen::Matrix3d R;

  explicit SomeCircle(unsigned seed) {
    const Points D = random_directions(3, seed);
    radius = std::pow(10.0, 8 * D(0, 0));
    center = radius * D.row(1).transpose();
    R = Eigen::AngleAxisd(3 * D(0, 1), D.row(2).transpose().normalized()).toRotationMatrix();
  }
  Vec3 at(double angle) const {
    return center + radius * (R * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  Vec3 direction(double angle) const { return R * Vec3(-std::sin(angle), std::cos(angle), 0); }

  /// The largest distance of the points from the circle in radii.
  double error(const CurvePoints& points) const {
    double largest = 0;
    for (const CurvePoint& point : points) {
      const Vec3 x = R.transpose() * (point.position - center) / radius;
      largest = std::max(largest, std::hypot(std::hypot(x[0], x[1]) - 1, x[2]));
    }
    return largest;
  }
};

TEST(CreaseCurves, TheEndOfAPolylineOnACircleIsTheCircle) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SomeCircle circle(seed);
    for (const double step : {0.001, 0.05, 0.3}) {
      std::vector<Vec3> points;
      for (int i = 0; i < 7; ++i) {
        points.push_back(circle.at(-step * i * (1 + 0.05 * i)));
      }
      const CurveEnd end = end_of_polyline(points);
      EXPECT_LT((end.direction - circle.direction(0)).norm(), 1e-9);
      EXPECT_LT((circle.radius * end.curvature - circle.R * Vec3(-1, 0, 0)).norm(), 1e-6);
      EXPECT_LT(deviation(end, circle.at(1.2)).cost, 1e-12);
      const Vec3 ahead = circle.at(0) + circle.radius * circle.direction(0);
      EXPECT_LT(deviation(end, ahead).angle, 1e-6);
      EXPECT_GT(deviation(end, ahead).cost, 0.01);
    }
  }
}

TEST(CreaseCurves, CirclesAndLinesComeBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SomeCircle circle(seed);
    for (const double angle : {1e-6, 0.1, 1.0, 2.5}) {
      const CurveEnd start{circle.at(0), circle.direction(0)};
      const CurveEnd other{circle.at(angle), -circle.direction(angle)};
      for (const CurvePoints& points :
           {blend(start, other, circle.radius * angle / 10),
            arc_to(start, other.position, circle.radius * angle / 10)}) {
        ASSERT_EQ(points.size(), 11u);
        EXPECT_LT(circle.error(points), 1e-9);
        EXPECT_EQ(points.front().position, start.position);
        EXPECT_EQ(points.back().position, other.position);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double there = angle * static_cast<double>(i) / 10;
          EXPECT_LT((points[i].position - circle.at(there)).norm(), 1e-3 * circle.radius * angle);
          EXPECT_LT((points[i].direction - circle.direction(there)).norm(), 0.01 * angle);
        }
      }
    }
    const Vec3 t = circle.direction(0), p = circle.center;
    const CurvePoints line = blend({p, t}, {p + circle.radius * t, -t}, circle.radius / 4);
    ASSERT_EQ(line.size(), 5u);
    for (std::size_t i = 0; i < line.size(); ++i) {
      EXPECT_LT((line[i].position - p - circle.radius * t * (0.25 * double(i))).norm(),
                1e-9 * circle.radius);
    }
  }
}

/// A blend keeps the directions at both ends, whatever they are.
TEST(CreaseCurves, BlendsKeepBothDirections) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const Points D = random_directions(3, seed);
    const Vec3 chord = D.row(0);
    const CurveEnd start{Vec3::Zero(), (chord + 0.5 * D.row(1).transpose()).normalized()};
    const CurveEnd other{chord, (-chord + 0.5 * D.row(2).transpose()).normalized()};
    const CurvePoints points = blend(start, other, chord.norm() / 400);
    EXPECT_LT(angle_between(points[1].position - points[0].position, start.direction), 0.02);
    EXPECT_LT(angle_between(points.end()[-2].position - points.back().position, other.direction),
              0.02);
  }
}

Filling fill_across(const State& state) {
  HoleChoice choice;
  choice.all = true;
  FillOptions options;
  options.choose_by_surroundings = true;
  options.sharp_angle = radians(30);
  return fill_holes(state.X, state.topology, choice, options);
}

/// Attributes of faces come from `model_triangle`: they must not cross a crease.
TEST(FillCreases, TrianglesTakeAfterTheirOwnSideOfTheCrease) {
  for (const Vec3& place : {Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(1, 0.8, 0.8)}) {
    const State state(without_rings(cube(5), place, 6));
    const Filling filling = fill_across(state);
    ASSERT_EQ(filling.holes[0].status, HoleStatus::filled);
    const FilledMesh filled = filled_mesh(state.topology, filling);
    const Points N = triangle_normals(filled.X, filled.F);
    for (Eigen::Index t = 0; t < filling.new_F.rows(); ++t) {
      const Vec3 here = N.row(state.topology.F.rows() + t);
      const Vec3 there = N.row(filling.model_triangle[static_cast<std::size_t>(t)]);
      EXPECT_LT((here - there).norm(), 1e-9);
    }
  }
}

TEST(FillCreases, SameBytesForAnyNumberOfThreads) {
  Mesh mesh = cube(5);
  for (const Vec3& place : {Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(-1, 0, 1), Vec3(-1, -1, -1)}) {
    mesh = without_rings(mesh, place, 4);
  }
  const State state(mesh);
  set_thread_count(1);
  const Filling one = fill_across(state);
  ASSERT_EQ(one.holes.size(), 4u);
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    const Filling again = fill_across(state);
    EXPECT_EQ(again.new_X, one.new_X);
    EXPECT_EQ(again.new_F, one.new_F);
  }
  set_thread_count(1);
}

TEST(FillCreases, TheMeshTellsItsSharpAngle) {
  for (const int level : {0, 2, 5}) {
    const State state(cube(level));
    EXPECT_GT(sharp_angle_of(state.X, state.topology), radians(20));
    EXPECT_LT(sharp_angle_of(state.X, state.topology), radians(89));
  }
  State ball(sphere(3));
  EXPECT_GT(sharp_angle_of(ball.X, ball.topology), radians(20));
  ball.X = shaken(ball, 0.3);
  EXPECT_EQ(sharp_angle_of(ball.X, ball.topology), 0);
}

}  // namespace
}  // namespace ibmfair::test
