// Guided filtering of normals: what it removes, what it keeps, and what it does not depend on.
#include "ibmfair/mesh/guided_normals.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "ibmfair/base/angle.h"
#include "ibmfair/mesh/geometry.h"
#include "ibmfair/shapes/noise.h"
#include "ibmfair/shapes/shapes.h"
#include "support/renumbered.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

constexpr double likeness = 0.35;

State shape(const std::string& name) {
  return State(make_shape(name, {.subdivide = 5}));
}

State noisy(const State& clean, double noise_in_edges) {
  State state = clean;
  add_noise(state.X, noise_in_edges * mean_edge_length(clean.X, clean.topology.E), 3);
  return state;
}

/// The mean angle between the rows of two lists of unit vectors, radians.
double mean_angle(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().unaryExpr([](double c) { return 2 * std::asin(c / 2); }).mean();
}

double largest_difference(const Points& a, const Points& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(GuidedNormals, RemoveMostOfTheNoiseAlsoAtCreases) {
  for (const char* name : {"cube", "icosahedron", "icosphere"}) {
    const State clean = shape(name);
    const Points truth = triangle_normals(clean.X, clean.topology.F);
    for (const double noise : {0.1, 0.3, 0.5}) {
      const State rough = noisy(clean, noise);
      const double before = mean_angle(triangle_normals(rough.X, rough.topology.F), truth);
      const Points normals = guided_normals(rough.X, rough.topology, 3, likeness);
      EXPECT_LT(mean_angle(normals, truth), 0.35 * before) << name << ", " << noise;
      EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
    }
  }
}

TEST(GuidedNormals, StayAsTheyAreOnPlanesAndAtSharpCreases) {
  const State plane(make_shape("plane", {})), cube = shape("cube");
  for (const State* state : {&plane, &cube}) {
    const Points before = triangle_normals(state->X, state->topology.F);
    const Points after = guided_normals(state->X, state->topology, 3, likeness);
    const auto changed = ((after - before).rowwise().norm().array() > 0.01).count();
    // At a corner of the cube, every patch reaches across a crease.
    EXPECT_LE(changed, state == &cube ? before.rows() / 50 : 0);
  }
}

TEST(GuidedNormals, TurnWithTheMeshAndDoNotDependOnScalePlaceAndNumbers) {
  const State rough = noisy(shape("icosahedron"), 0.3);
  const Points normals = guided_normals(rough.X, rough.topology, 3, likeness);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1e-30, 1.0, 1e30}) {
    const Points X = scale * ((rough.X * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3));
    EXPECT_LT(largest_difference(guided_normals(X, rough.topology, 3, likeness),
                                 normals * turn.transpose()),
              1e-9)
        << scale;
  }
  const TriangleMesh other =
      renumbered({rough.X, rough.topology.F}, permutation(rough.X.rows(), 5));
  const State same(mesh_from_triangles(other.X, other.F));
  EXPECT_LT(largest_difference(guided_normals(same.X, same.topology, 3, likeness),
                               normals(permutation(normals.rows(), 5), Eigen::all)),
            1e-9);
}

TEST(FitToNormals, TurnsTrianglesAndKeepsFixedVertices) {
  const State clean = shape("cube"), rough = noisy(clean, 0.3);
  const Points truth = triangle_normals(clean.X, clean.topology.F);
  std::vector<std::uint8_t> fixed(rough.X.rows(), 0);
  fixed[0] = fixed[7] = 1;
  const Points fitted = fit_to_normals(rough.X, rough.topology, fixed, truth, 20);
  EXPECT_LT(mean_angle(triangle_normals(fitted, clean.topology.F), truth),
            0.35 * mean_angle(triangle_normals(rough.X, clean.topology.F), truth));
  EXPECT_EQ(fitted.row(0), rough.X.row(0));
  EXPECT_EQ(fitted.row(7), rough.X.row(7));
  const Points same = fit_to_normals(clean.X, clean.topology, fixed, truth, 20);
  EXPECT_LT(largest_difference(same, clean.X), 1e-14);
}

}  // namespace
}  // namespace ibmfair::test
