// The conservation laws that time integration keeps, and the orders at which it breaks the others.
#include <cmath>

#include <gtest/gtest.h>

#include "cloth/explicit_euler.h"
#include "cloth/scenes.h"
#include "support/cloth_sheets.h"
#include "support/states.h"

namespace ibmfair::cloth {
namespace {

/// One row of the table of integrators and one row of the table of bending forces.
struct MotionCase {
  IntegratorRow integrator;
  BendingForce bending;
};

/// All cases, or only the cases with the integrator of this name.
std::vector<MotionCase> motion_cases(std::string_view only = "") {
  std::vector<MotionCase> cases;
  for (const IntegratorRow& integrator : integrators()) {
    if (!only.empty() && integrator.name != only) {
      continue;
    }
    for (const BendingForce& bending : bending_forces()) {
      cases.push_back({integrator, bending});
    }
  }
  return cases;
}

std::string motion_name(const testing::TestParamInfo<MotionCase>& info) {
  return fmt::format("{}_{}", info.param.integrator.name, info.param.bending.name);
}

/// A small sheet in empty space, bent and with random velocities.
class FreeSheet : public testing::TestWithParam<MotionCase> {
 protected:
  FreeSheet() { surroundings_.gravity.setZero(); }

  std::unique_ptr<Integrator> create(const Plate& plate, const StepOptions& options = {}) const {
    return GetParam().integrator.create(plate, surroundings_, GetParam().bending, options);
  }

  static Motion tumbling(const Plate& plate) {
    Motion motion = at_rest(plate.rest);
    motion.X.col(2) = 0.1 * test::crumpled(plate.rest).col(2);
    motion.V = test::random_directions(motion.X.rows()) * 0.1;
    motion.V.col(0) += 0.5 * plate.rest.col(1);
    motion.V.col(2) += plate.rest.col(0);
    return motion;
  }

  static Vec3 momentum(const Plate& plate, const Motion& motion) {
    return motion.V.transpose() * plate.mass;
  }

  static Vec3 angular_momentum(const Plate& plate, const Motion& motion) {
    Vec3 sum = Vec3::Zero();
    for (Index v = 0; v < motion.X.rows(); ++v) {
      sum += plate.mass[v] * Vec3(motion.X.row(v)).cross(Vec3(motion.V.row(v)));
    }
    return sum;
  }

  /// The relative error of the angular momentum after `seconds` in steps of h.
  double angular_drift(const Plate& plate, double h, double seconds) const {
    Motion motion = tumbling(plate);
    const Vec3 before = angular_momentum(plate, motion);
    StepOptions options;
    options.time_step = h;
    options.tolerance = 1e-9;
    advance(*create(plate, options), seconds, motion);
    return (angular_momentum(plate, motion) - before).norm() / before.norm();
  }

  Surroundings surroundings_;
};

class FreeSheetInExplicitSteps : public FreeSheet {};
class FreeSheetInImplicitSteps : public FreeSheet {};

TEST_P(FreeSheet, KeepsItsMomentum) {
  const Plate plate = test::small_plate(sheet_meshes()[1], {.strain_damping = 1e-3});
  Motion motion = tumbling(plate);
  const Vec3 before = momentum(plate, motion);
  StepOptions options;
  options.tolerance = 1e-9;
  const auto stepper = create(plate, options);
  for (int i = 0; i < 20; ++i) {
    stepper->step(motion);
  }
  EXPECT_LE((momentum(plate, motion) - before).norm(), 1e-9 * before.norm());
}

// The sum of x_k x f(x_k) is zero, so symplectic Euler keeps the angular momentum to rounding. The
// rates of strain are zero for rotations in the membrane and in the hinge, but not in IBM.
TEST_P(FreeSheetInExplicitSteps, KeepsItsAngularMomentum) {
  const Plate elastic = test::small_plate(sheet_meshes()[1]);
  EXPECT_LE(angular_drift(elastic, 0, 0.02), 1e-12);
  const Plate damped = test::small_plate(sheet_meshes()[1], {.strain_damping = 1e-3});
  if (GetParam().bending.name == "hinge") {
    EXPECT_LE(angular_drift(damped, 0, 0.02), 1e-12);
  }
}

// Implicit Euler takes the moments of the forces at x_{k+1}: the angular momentum is off by h v x f
// in each step, and by a first-order error in all.
TEST_P(FreeSheetInImplicitSteps, LosesAngularMomentumToFirstOrder) {
  const Plate plate = test::small_plate(sheet_meshes()[1], {.young = 10, .bending = 1e-4});
  const double coarse = angular_drift(plate, 0.002, 0.04), fine = angular_drift(plate, 0.001, 0.04);
  EXPECT_LE(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 2, 0.4);
}

// Both methods are exact for constant forces, except that each sums the velocities in its own way.
TEST_P(FreeSheet, FallsAsTheMethodSays) {
  surroundings_.gravity = {1, -9.81, 2};
  const Plate plate = test::small_plate(sheet_meshes()[0]);
  Motion motion = at_rest(plate.rest);
  const auto stepper = create(plate);
  constexpr int steps = 10;
  for (int i = 0; i < steps; ++i) {
    stepper->step(motion);
  }
  const double h = stepper->time_step();
  const Vec3 fallen = steps * (steps + 1) / 2.0 * h * h * surroundings_.gravity;
  const Points expected = plate.rest.rowwise() + fallen.transpose();
  EXPECT_LE((motion.X - expected).norm(), 1e-9 * (expected - plate.rest).norm());
}

TEST_P(FreeSheet, StopsMovingByMassDampingAsTheMethodSays) {
  const Plate plate = test::small_plate(sheet_meshes()[0], {.mass_damping = 3});
  Motion motion = at_rest(plate.rest);
  motion.V.rowwise() = Eigen::RowVector3d(1, 2, 3);
  const auto stepper = create(plate);
  for (int i = 0; i < 10; ++i) {
    stepper->step(motion);
  }
  const double kept = std::pow(1 + 3 * stepper->time_step(), -10);
  EXPECT_LE((motion.V.rowwise() - kept * Eigen::RowVector3d(1, 2, 3)).norm(),
            1e-9 * motion.V.norm());
}

TEST_P(FreeSheet, LosesEnergyByStrainDamping) {
  const auto energy_after = [&](double damping) {
    const Material material{.young = 100, .bending = 1e-3, .strain_damping = damping};
    const Plate plate = test::small_plate(sheet_meshes()[1], material);
    Motion motion = tumbling(plate);
    StepOptions options;
    options.time_step = 2e-4;
    advance(*create(plate, options), 0.02, motion);
    ElasticSheet sheet(plate, GetParam().bending);
    return sheet.membrane->energy(motion.X) + sheet.bending->energy(motion.X) +
           plate.mass.dot(motion.V.rowwise().squaredNorm()) / 2;
  };
  const double undamped = energy_after(0), little = energy_after(1e-4), much = energy_after(1e-3);
  EXPECT_LT(little, 0.999 * undamped);
  EXPECT_LT(much, 0.99 * little);
}

TEST_P(FreeSheet, StaysWhereItIsWhenNothingActs) {
  const Plate plate =
      test::small_plate(sheet_meshes()[0], {.mass_damping = 1, .strain_damping = 1e-3});
  Motion motion = at_rest(plate.rest);
  const auto stepper = create(plate);
  for (int i = 0; i < 5; ++i) {
    stepper->step(motion);
  }
  EXPECT_LE((motion.X - plate.rest).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Tables, FreeSheet, testing::ValuesIn(motion_cases()), motion_name);
INSTANTIATE_TEST_SUITE_P(Tables, FreeSheetInExplicitSteps,
                         testing::ValuesIn(motion_cases("explicit")), motion_name);
INSTANTIATE_TEST_SUITE_P(Tables, FreeSheetInImplicitSteps,
                         testing::ValuesIn(motion_cases("implicit")), motion_name);

class IntegratorsAgree : public testing::TestWithParam<BendingForce> {};

TEST_P(IntegratorsAgree, AsTheImplicitStepGetsShorterToFirstOrder) {
  const Material material{.young = 10, .bending = 1e-4, .mass_damping = 1, .strain_damping = 1e-3};
  const Plate plate = test::small_plate(sheet_meshes()[1], material);
  Surroundings surroundings;
  surroundings.wind = {2, 0, 3};
  surroundings.drag = 0.5;
  const auto after = [&](std::string_view name, double h) {
    Motion motion = at_rest(plate.rest);
    motion.X.col(2) = 0.1 * test::crumpled(plate.rest).col(2);
    const StepOptions options{.time_step = h, .tolerance = 1e-6};
    advance(*integrator(name).create(plate, surroundings, GetParam(), options), 0.04, motion);
    return motion.X;
  };
  const Points fine = after("explicit", 4e-5);
  const double long_steps = (after("implicit", 2e-3) - fine).norm();
  const double short_steps = (after("implicit", 1e-3) - fine).norm();
  EXPECT_LE(short_steps, 0.05 * (fine - plate.rest).norm());
  EXPECT_NEAR(long_steps / short_steps, 2, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Tables, IntegratorsAgree,
                         testing::ValuesIn(bending_forces().begin(), bending_forces().end()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(StableTimeStep, IsStableAndTwoAndAHalfTimesItIsNot) {
  for (const BendingForce& bending : bending_forces()) {
    for (const double damping : {0.0, 1e-3}) {
      const Plate plate = test::small_plate(sheet_meshes()[1], {.strain_damping = damping});
      ElasticSheet sheet(plate, bending);
      const double h = stable_time_step(plate, sheet);
      Surroundings space;
      space.gravity.setZero();
      const auto largest_speed = [&](double step) {
        Motion motion = at_rest(plate.rest);
        motion.V = 1e-6 * test::random_directions(motion.X.rows());
        advance(*integrator("explicit").create(plate, space, bending, {.time_step = step}),
                400 * step, motion);
        return motion.V.cwiseAbs().maxCoeff();
      };
      EXPECT_LE(largest_speed(h), 1e-5) << bending.name << " " << damping;
      EXPECT_FALSE(largest_speed(2.5 * h) < 1e-3) << bending.name << " " << damping;
    }
  }
}

class SceneRuns : public testing::TestWithParam<std::tuple<SceneRow, SheetMesh, MotionCase>> {};

TEST_P(SceneRuns, HoldsWhatIsHeldAndStaysOutOfTheSphere) {
  const auto& [row, mesh, methods] = GetParam();
  const Scene scene = row.build(mesh.make(100));
  StepOptions options;
  options.time_step = methods.integrator.name == "implicit" ? row.time_step : 0;
  const auto stepper =
      methods.integrator.create(scene.plate, scene.surroundings, methods.bending, options);
  Motion motion = at_rest(scene.start);
  for (int frame = 0; frame < 2; ++frame) {
    advance(*stepper, 0.05, motion);
    ASSERT_TRUE(motion.X.allFinite());
    for (Index v = 0; v < motion.X.rows(); ++v) {
      if (scene.plate.fixed[v]) {
        EXPECT_EQ(motion.X.row(v), scene.start.row(v));
      }
      if (const auto& sphere = scene.surroundings.sphere) {
        const double distance = (motion.X.row(v).transpose() - sphere->centre).norm();
        EXPECT_GE(distance, (1 - 1e-12) * sphere->radius);
      }
    }
  }
  EXPECT_GT((motion.X - scene.start).rowwise().norm().maxCoeff(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Tables, SceneRuns,
                         testing::Combine(testing::ValuesIn(scenes().begin(), scenes().end()),
                                          testing::ValuesIn(sheet_meshes().begin(),
                                                            sheet_meshes().end()),
                                          testing::ValuesIn(motion_cases())),
                         [](const auto& info) {
                           const MotionCase& methods = std::get<2>(info.param);
                           return fmt::format("{}_{}_{}_{}", std::get<0>(info.param).name,
                                              std::get<1>(info.param).name, methods.integrator.name,
                                              methods.bending.name);
                         });

}  // namespace
}  // namespace ibmfair::cloth
