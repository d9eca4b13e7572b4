// The meshes of the sheets, contact with obstacles, and the tables of methods.
#include <cmath>

#include <gtest/gtest.h>

#include "cloth/frames.h"
#include "cloth/sphere_contact.h"
#include "cloth/timing_table.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "support/cloth_sheets.h"
#include "support/states.h"
#include "support/temporary_directory.h"

namespace ibmfair::cloth {
namespace {

class SheetMeshes : public testing::TestWithParam<std::tuple<SheetMesh, Index>> {};

TEST_P(SheetMeshes, CoverTheUnitSquareWithGoodTriangles) {
  const auto& [row, vertices] = GetParam();
  const TriangleMesh mesh = row.make(vertices);
  const Topology topology = build_topology(mesh.X, mesh.F);
  if (row.name == "irregular") {
    EXPECT_EQ(mesh.X.rows(), vertices);
  }
  EXPECT_NEAR(surface_area(mesh.X, mesh.F), 1, 1e-12);
  EXPECT_TRUE(topology.defects.empty());
  EXPECT_EQ(topology.turned_triangles, 0);
  EXPECT_EQ(topology.euler_characteristic(), 1);
  EXPECT_GT(smallest_angle(mesh.X, mesh.F), 5 * M_PI / 180);
  EXPECT_GT(triangle_normals(mesh.X, mesh.F).col(2).minCoeff(), 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, SheetMeshes,
                         testing::Combine(testing::ValuesIn(sheet_meshes().begin(),
                                                            sheet_meshes().end()),
                                          testing::Values(64, 450, 2100)),
                         [](const auto& info) {
                           return fmt::format("{}_{}", std::get<0>(info.param).name,
                                              std::get<1>(info.param));
                         });

/// Four single vertices that slide on a sphere of radius 1, stick to it, are outside it, or are
/// fixed.
TEST(PushOut, TakesTheVelocityInwardsAndFriction) {
  Sphere sphere;
  sphere.radius = 1;
  sphere.friction = 0.5;
  Plate plate;
  plate.fixed = {0, 0, 0, 1};
  Points X(4, 3), V(4, 3);
  X << 0.9, 0, 0, 0, 0.9, 0, 1.1, 0, 0, 0.9, 0, 0;
  V << -1, 2, 0,   // slides on, slower
      0.4, -1, 0,  // sticks
      -1, 2, 0,    // outside
      0, 0, 0;     // fixed
  push_out(sphere, 1, plate, X, V);
  Points expected_X(4, 3), expected_V(4, 3);
  expected_X << 1, 0, 0, 0, 1, 0, 1.1, 0, 0, 0.9, 0, 0;
  expected_V << 0, 1.5, 0, 0, 0, 0, -1, 2, 0, 0, 0, 0;
  EXPECT_LE((X - expected_X).norm(), 1e-15);
  EXPECT_LE((V - expected_V).norm(), 1e-15);
}

TEST(Contact, HasTheDerivativesOfItsEnergy) {
  const Plate plate = test::small_plate(sheet_meshes()[1]);
  BlockHessian H(element_rows(plate.topology), static_cast<Index>(plate.rest.rows()));
  Sphere sphere;
  sphere.centre = {0.5, 0.5, -0.25};
  const auto contact = bind_contact(sphere, plate, 0.01, H);
  const Points X = plate.rest + 0.01 * test::random_directions(plate.rest.rows());
  contact->start_step(plate.rest, 0);
  contact->start_step(X, 0);
  const Points D = test::random_directions(X.rows(), 7), moved = X + 0.003 * D;
  constexpr double t = 1e-6;
  const auto gradient = [&](const Points& at) {
    Points G = Points::Zero(at.rows(), 3);
    contact->add_gradient(at, G);
    return G;
  };
  const double slope = gradient(moved).cwiseProduct(D).sum();
  EXPECT_NEAR((contact->energy(moved + t * D) - contact->energy(moved - t * D)) / (2 * t), slope,
              1e-6 * std::abs(slope));
  contact->add_hessian(moved, HessianPart::exact, H);
  const Points exact = H.multiply(D);
  EXPECT_LE(((gradient(moved + t * D) - gradient(moved - t * D)) / (2 * t) - exact).norm(),
            1e-5 * exact.norm());
}

TEST(Tables, NameWhatThereIsForNamesThatTheyLack) {
  EXPECT_EQ(bending_force("ibm").name, "ibm");
  EXPECT_EQ(integrator("explicit").name, "explicit");
  EXPECT_EQ(scene("flag").name, "flag");
  try {
    scene("curtain");
    FAIL();
  } catch (const BadOption& error) {
    EXPECT_STREQ(error.what(), "unknown scene 'curtain' (there are drape, flag)");
  }
}

TEST(Frames, ReadBackAsTheyWere) {
  const Scene built = scene("flag").build(regular_sheet(36));
  const auto stepper =
      integrator("implicit").create(built.plate, built.surroundings, bending_force("ibm"), {});
  const std::vector<Points> frames = run_frames(built, *stepper, 0.1);
  ASSERT_EQ(frames.size(), 1 + std::lround(0.1 * frames_per_second));
  EXPECT_EQ(frames.front(), built.start);
  for (const std::string format : {"obj", "ply", "off"}) {
    const test::TemporaryDirectory directory;
    const std::string folder = directory / "frames";
    write_frames(built, frames, folder, format);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(read_mesh(frame_path(folder, i, format)).mesh().X, frames[i]) << format;
    }
  }
}

TEST(Frames, ArePutBesideEachOther) {
  const SceneRow& row = scene("flag");
  const Scene built = row.build(regular_sheet(36));
  const Image two = picture_of(built, {built.start, built.start}, row.view, 2);
  EXPECT_EQ(two.width, 2 * picture_width);
  EXPECT_LE(two.height, picture_width);
  EXPECT_NE(two.at(picture_width / 2, two.height / 2), (Rgb{255, 255, 255}));
  EXPECT_NE(two.at(3 * picture_width / 2, two.height / 2), (Rgb{255, 255, 255}));
}

TEST(TimingTable, MeasuresEveryQuantityOfEveryModel) {
  const std::vector<Costs> costs = measure_costs(scenes()[0], regular_sheet(36), 1e-4);
  ASSERT_EQ(costs.size(), bending_forces().size());
  for (const Costs& of_model : costs) {
    for (const double cost : of_model) {
      EXPECT_GT(cost, 0);
      EXPECT_LT(cost, 1000);
    }
  }
}

}  // namespace
}  // namespace ibmfair::cloth
