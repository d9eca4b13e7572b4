// The behaviour of the sheet's energies under rigid motions and near the flat state.
#include <cmath>

#include <gtest/gtest.h>

#include "ibmfair/energy/bending_energy.h"
#include "support/cloth_sheets.h"
#include "support/states.h"

namespace ibmfair::cloth {
namespace {

struct InvarianceCase {
  test::TermRow term;
  SheetMesh mesh;
};

class EnergyInvariance : public testing::TestWithParam<InvarianceCase> {
 protected:
  EnergyInvariance()
      : plate_(test::small_plate(GetParam().mesh)),
        H_(element_rows(plate_.topology), static_cast<Index>(plate_.rest.rows())),
        term_(GetParam().term.create(plate_, H_)),
        X_(test::crumpled(plate_.rest)) {}

  Points gradient(const Points& X) {
    Points G = Points::Zero(X.rows(), 3);
    term_->add_gradient(X, G);
    return G;
  }

  Plate plate_;
  BlockHessian H_;
  std::unique_ptr<EnergyTerm> term_;
  Points X_;
  const Eigen::Matrix3d turn_ =
      Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
};

TEST_P(EnergyInvariance, IsZeroAtRest) {
  EXPECT_LE(term_->energy(plate_.rest), 1e-14 * term_->energy(X_));
  EXPECT_LE(gradient(plate_.rest).norm(), 1e-12 * gradient(X_).norm());
}

TEST_P(EnergyInvariance, StaysUnderRigidMotions) {
  const Points moved = (X_ * turn_.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  const double E = term_->energy(X_);
  EXPECT_NEAR(term_->energy(moved), E, 1e-10 * E);
}

TEST_P(EnergyInvariance, ForcesTurnWithTheSheet) {
  const Points G = gradient(X_);
  EXPECT_LE((gradient(X_ * turn_.transpose()) - G * turn_.transpose()).norm(), 1e-10 * G.norm());
}

TEST_P(EnergyInvariance, ForcesHaveNeitherSumNorMoment) {
  const Points G = gradient(X_);
  Vec3 moment = Vec3::Zero();
  for (Index v = 0; v < G.rows(); ++v) {
    moment += Vec3(X_.row(v)).cross(Vec3(G.row(v)));
  }
  EXPECT_LE(G.colwise().sum().norm(), 1e-11 * G.norm());
  EXPECT_LE(moment.norm(), 1e-11 * G.norm());
}

std::vector<InvarianceCase> invariance_cases() {
  std::vector<InvarianceCase> cases;
  for (const test::TermRow& term : test::terms()) {
    for (const SheetMesh& mesh : sheet_meshes()) {
      cases.push_back({term, mesh});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Terms, EnergyInvariance, testing::ValuesIn(invariance_cases()),
                         [](const auto& info) {
                           return fmt::format("{}_{}", info.param.term.name, info.param.mesh.name);
                         });

class BendingModelsAgree : public testing::TestWithParam<SheetMesh> {
 protected:
  BendingModelsAgree()
      : plate_(test::small_plate(GetParam())),
        H_(element_rows(plate_.topology), static_cast<Index>(plate_.rest.rows())) {}

  /// Energies and gradients of the two bending models when the sheet is bent by this amplitude.
  struct Two {
    double energy[2];
    Points gradient[2];
  };

  Two bent(double amplitude) {
    Points X = plate_.rest;
    X.col(2) = amplitude * test::crumpled(plate_.rest).col(2);
    Two two{{}, {Points::Zero(X.rows(), 3), Points::Zero(X.rows(), 3)}};
    for (int model = 0; model < 2; ++model) {
      const auto term = bending_forces()[model].create(plate_, H_);
      two.energy[model] = term->energy(X);
      term->add_gradient(X, two.gradient[model]);
    }
    return two;
  }

  Plate plate_;
  BlockHessian H_;
};

// [W07] Theorem 2: the relative difference of the two energies is of second order in the amplitude.
TEST_P(BendingModelsAgree, InTheEnergyUpToSecondOrder) {
  const auto relative_difference = [&](double amplitude) {
    const Two two = bent(amplitude);
    return std::abs(two.energy[0] / two.energy[1] - 1);
  };
  const double coarse = relative_difference(0.04), fine = relative_difference(0.02);
  EXPECT_LE(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
}

TEST_P(BendingModelsAgree, InTheNormalForceToFirstOrder) {
  const auto relative_difference = [&](double amplitude) {
    const Two two = bent(amplitude);
    return (two.gradient[0] - two.gradient[1]).col(2).norm() / two.gradient[1].col(2).norm();
  };
  const double coarse = relative_difference(0.04), fine = relative_difference(0.02);
  EXPECT_LE(fine, 0.05);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
}

TEST_P(BendingModelsAgree, InTheHessianAtRest) {
  Eigen::MatrixXd hessian[2];
  for (int model = 0; model < 2; ++model) {
    const auto term = bending_forces()[model].create(plate_, H_);
    H_.clear();
    term->add_hessian(plate_.rest, HessianPart::exact, H_);
    hessian[model] = test::dense(H_);
  }
  const auto normal = Eigen::seqN(2, plate_.rest.rows(), 3);
  const Eigen::MatrixXd hinge = hessian[0](normal, normal), ibm = hessian[1](normal, normal);
  EXPECT_LE((hinge - ibm).norm(), 1e-12 * ibm.norm());
}

TEST_P(BendingModelsAgree, WithTheLibrarysEnergyUnderIsometry) {
  Points rolled = plate_.rest;  // rolled onto a cylinder of radius 1/2, nearly an isometry
  rolled.col(0) = (2 * plate_.rest.col(0).array()).sin() / 2;
  rolled.col(2) = (1 - (2 * plate_.rest.col(0).array()).cos()) / 2;
  const auto ibm = bending_force("ibm").create(plate_, H_);
  const double E = bending_energy(rolled, plate_.topology, "crouzeix-raviart");
  EXPECT_NEAR(ibm->energy(rolled) / plate_.material.bending, E, 0.02 * E);
}

INSTANTIATE_TEST_SUITE_P(Meshes, BendingModelsAgree,
                         testing::ValuesIn(sheet_meshes().begin(), sheet_meshes().end()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace ibmfair::cloth
