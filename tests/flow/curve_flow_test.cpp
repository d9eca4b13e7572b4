// The flow of a polyline along itself: how much of a ripple is left, what stays, and invariances.
#include "ibmfair/flow/passes/curve_flow.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

using std::numbers::pi;

/// Points on a line along x, `spacing(i)` apart, with heights height(x) in y.
template <class Spacing, class Height>
Points curve_along_x(Eigen::Index count, const Spacing& spacing, const Height& height) {
  Points X = Points::Zero(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    X(i, 0) = i == 0 ? 0 : X(i - 1, 0) + spacing(i);
    X(i, 1) = height(X(i, 0));
  }
  return X;
}

double even(Eigen::Index) {
  return 1;
}

double uneven(Eigen::Index i) {
  return 1 + 0.5 * std::sin(3.7 * static_cast<double>(i));
}

Points circle(Eigen::Index count, double noise = 0) {
  Points X = Points::Zero(count, 3);
  RandomNumbers random(7);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(count);
    X.row(i) << std::cos(angle), std::sin(angle), 0;
    X.row(i) *= static_cast<double>(count) / (2 * pi);
    X.row(i) += noise * Vec3(random.normal(), random.normal(), random.normal()).transpose();
  }
  return X;
}

/// The part of a ripple that n steps of backward Euler leave, at wave number * cutoff = 2 pi q.
double share_left(double q, int steps, int twicing = 0) {
  const double g = std::pow(1 + std::pow(q, 4) / steps, -steps);
  return 1 - std::pow(1 - g, twicing + 1);
}

TEST(CurveFlow, LeavesOfARippleWhatTheFlowOfASheetLeaves) {
  const double wavelength = 40;
  const auto sine = [&](double x) { return 1e-4 * std::sin(2 * pi * x / wavelength); };
  const Points X = curve_along_x(401, even, sine);  // ten waves
  for (const double q : {0.5, 1.0, 1.5}) {
    for (const int twicing : {0, 1, 2}) {
      const Points Y = curve_flow(X, CurveEnds::natural, {q * wavelength, 6, twicing, {}});
      const double amplitude = Y.col(1).segment(160, 80).dot(X.col(1).segment(160, 80)) /
                               X.col(1).segment(160, 80).squaredNorm();
      EXPECT_NEAR(amplitude, share_left(q, 6, twicing), 0.01) << q << " " << twicing;
    }
  }
}

// A ripple on a sheet, smoothed by the flow of surfaces, is compared along the middle of the sheet.
TEST(CurveFlow, DampsAsTheFlowOfSurfacesDoes) {
  const Eigen::Index columns = 121;
  State sheet(flat_sheet(columns - 1, 40));
  const double edge = sheet.X(1, 0) - sheet.X(0, 0), wavelength = 20 * std::abs(edge);
  for (Eigen::Index v = 0; v < sheet.X.rows(); ++v) {
    sheet.X(v, 2) = 1e-4 * edge * std::sin(2 * pi * sheet.X(v, 0) / wavelength);
  }
  const Points before = sheet.X;
  FlowOptions options;
  options.laplacian = "lagrange";
  options.relax = false;
  options.steps = 6;
  options.solver_tolerance = 1e-8;
  options.total_time = time_for_cutoff(wavelength);
  willmore_flow(sheet.X, sheet.topology, fixed_vertices(sheet.topology, BoundaryCondition::free),
                options);
  const Eigen::Index first = 20 * columns, from = 40, length = 40;
  const Points line = before.middleRows(first, columns);
  const Points Y = curve_flow(line, CurveEnds::natural, {wavelength, 6, 0, {}});
  const auto share = [&](const Points& after) {
    return after.col(2).segment(from, length).dot(line.col(2).segment(from, length)) /
           line.col(2).segment(from, length).squaredNorm();
  };
  EXPECT_NEAR(share(Y), share_left(1, 6), 0.01);
  EXPECT_NEAR(share(sheet.X.middleRows(first, columns)), share(Y), 0.02);
}

TEST(CurveFlow, KeepsStraightLinesHoweverTheyAreDivided) {
  for (const CurveEnds ends : {CurveEnds::natural, CurveEnds::clamped}) {
    for (const double size : {1e-12, 1.0, 1e12}) {
      Points X = size * curve_along_x(60, uneven, [](double x) { return 0.3 * x; });
      for (const double cutoff : {0.1, 8.0, 1e3}) {
        const Points Y = curve_flow(X, ends, {cutoff * size, 8, 1, {}});
        EXPECT_LT((Y - X).rowwise().norm().maxCoeff(), 1e-8 * size) << cutoff << " " << size;
      }
      X.row(31) = X.row(30);  // an edge without length counts as a thousandth of the mean
      const Points Y = curve_flow(X, ends, {8 * size, 8, 1, {}});
      EXPECT_LT((Y - X).rowwise().norm().maxCoeff(), 1e-3 * size) << size;
    }
  }
}

TEST(CurveFlow, KeepsCirclesAtAnyCutoff) {
  for (const Eigen::Index count : {4, 6, 12, 88}) {
    const Points X = circle(count);
    for (const double cutoff : {1.0, 8.0, 40.0, 1e4}) {
      for (const int twicing : {0, 1}) {
        const Points Y = curve_flow(X, CurveEnds::closed, {cutoff, 8, twicing, {}});
        EXPECT_LT((Y - X).rowwise().norm().maxCoeff(), 1e-6 * static_cast<double>(count))
            << count << " " << cutoff;
      }
    }
  }
}

TEST(CurveFlow, BringsNoisyCirclesNearerToTheTruth) {
  for (const Eigen::Index count : {24, 88, 400}) {
    const Points noisy = circle(count, 0.15);
    const Points Y = curve_flow(noisy, CurveEnds::closed, {8, 8, 1, {}});
    const double radius = static_cast<double>(count) / (2 * pi);
    const auto error = [&](const Points& P) {
      const Eigen::ArrayXd in_plane = P.leftCols<2>().rowwise().norm().array() - radius;
      return std::sqrt((in_plane.square() + P.col(2).array().square()).mean());
    };
    EXPECT_LT(error(Y), 0.65 * error(noisy)) << count;
    EXPECT_NEAR(Y.leftCols<2>().rowwise().norm().mean(), radius, 0.05) << count;
  }
}

TEST(CurveFlow, KeepsEndsAndFixedPointsInEveryBit) {
  const Points X = circle(40, 0.2);
  CurveFlowOptions options{10, 4, 1, Eigen::VectorXd::Ones(40)};
  options.cutoff_factor[7] = options.cutoff_factor[20] = 0;
  for (const CurveEnds ends : {CurveEnds::closed, CurveEnds::natural, CurveEnds::clamped}) {
    const Points Y = curve_flow(X, ends, options);
    EXPECT_EQ(Y.row(7), X.row(7));
    EXPECT_EQ(Y.row(20), X.row(20));
    EXPECT_NE(Y.row(10), X.row(10));
    EXPECT_EQ(Y.row(0) == X.row(0), ends != CurveEnds::closed);
    EXPECT_EQ(Y.row(1) == X.row(1), ends == CurveEnds::clamped);
    EXPECT_EQ(Y.row(39) == X.row(39), ends != CurveEnds::closed);
  }
}

TEST(CurveFlow, MovesLessWhereTheCutoffIsShorter) {
  const Points X = circle(80, 0.2);
  const auto moves = [&](double factor) {
    CurveFlowOptions options{8, 4, 0, Eigen::VectorXd::Ones(80)};
    options.cutoff_factor.head(40).setConstant(factor);
    const Points Y = curve_flow(X, CurveEnds::closed, options);
    return (Y - X).middleRows(5, 30).norm();
  };
  EXPECT_LT(moves(0.1), 0.02 * moves(1));
  const Points Y = curve_flow(X, CurveEnds::closed, {0.01, 4, 0, {}});
  EXPECT_LT((Y - X).rowwise().norm().maxCoeff(), 1e-9);
}

TEST(CurveFlow, DoesNotDependOnPlaceDirectionOrderAndSize) {
  const Points X = circle(50, 0.2);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  const Eigen::RowVector3d shift(100, -50, 7);
  for (const CurveEnds ends : {CurveEnds::closed, CurveEnds::natural, CurveEnds::clamped}) {
    const Points Y = curve_flow(X, ends, {8, 8, 1, {}});
    const Points moved = (X * turn.transpose()).rowwise() + shift;
    EXPECT_LT(
        (curve_flow(moved, ends, {8, 8, 1, {}}) - Points((Y * turn.transpose()).rowwise() + shift))
            .cwiseAbs()
            .maxCoeff(),
        1e-9);
    const Points reversed = X.colwise().reverse();
    EXPECT_LT((curve_flow(reversed, ends, {8, 8, 1, {}}) - Points(Y.colwise().reverse()))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    for (const double size : {1e-30, 1e30}) {
      const Points scaled = curve_flow(size * X, ends, {8 * size, 8, 1, {}});
      EXPECT_LT((scaled / size - Y).cwiseAbs().maxCoeff(), 1e-9) << size;
    }
  }
}

TEST(CurveFlow, LeavesWhatHasNoLengthAndRefusesBadOptions) {
  for (const Eigen::Index count : {0, 1, 2, 5}) {
    const Points X = Points::Constant(count, 3, 2.5);
    for (const CurveEnds ends : {CurveEnds::closed, CurveEnds::natural, CurveEnds::clamped}) {
      EXPECT_EQ(curve_flow(X, ends, {1, 8, 1, {}}), X);
    }
  }
  const Points X = circle(10);
  EXPECT_THROW(curve_flow(X, CurveEnds::closed, {}), BadOption);
  EXPECT_THROW(curve_flow(X, CurveEnds::closed, {std::nan(""), 8, 0, {}}), BadOption);
  EXPECT_THROW(curve_flow(X, CurveEnds::closed, {1, 0, 0, {}}), BadOption);
  EXPECT_THROW(curve_flow(X, CurveEnds::closed, {1, 8, 0, Eigen::VectorXd::Ones(3)}), BadOption);
}

}  // namespace
}  // namespace ibmfair::test
