// Gradients and Hessians of the sheet's energies agree with central differences.
#include <cmath>

#include <gtest/gtest.h>

#include "support/cloth_sheets.h"
#include "support/states.h"

namespace ibmfair::cloth {
namespace {

using test::random_directions;

/// A term of the energy, a sheet with one kind of mesh, and whether the term is damped.
struct DerivativeCase {
  test::TermRow term;
  SheetMesh mesh;
  bool damped;
};

class EnergyDerivatives : public testing::TestWithParam<DerivativeCase> {
 protected:
  EnergyDerivatives()
      : plate_(test::small_plate(GetParam().mesh)),
        H_(element_rows(plate_.topology), static_cast<Index>(plate_.rest.rows())),
        term_(GetParam().term.create(plate_, H_)),
        X_(test::crumpled(plate_.rest)) {
    if (GetParam().damped) {
      const Points before = X_ + 0.01 * random_directions(X_.rows(), 5);
      term_->energy(before);
      term_->start_step(before, 0.7);
    }
  }

  Points gradient(const Points& X) {
    Points G = Points::Zero(X.rows(), 3);
    term_->add_gradient(X, G);
    return G;
  }

  /// The error of the difference quotient of step t.
  double gradient_error(double t) {
    const Points D = random_directions(X_.rows());
    const double quotient = (term_->energy(X_ + t * D) - term_->energy(X_ - t * D)) / (2 * t);
    const double exact = gradient(X_).cwiseProduct(D).sum();
    return std::abs(quotient - exact) / std::abs(exact);
  }

  double hessian_error(double t) {
    const Points D = random_directions(X_.rows());
    const Points quotient = (gradient(X_ + t * D) - gradient(X_ - t * D)) / (2 * t);
    H_.clear();
    term_->add_hessian(X_, HessianPart::exact, H_);
    const Points exact = H_.multiply(D);
    return (quotient - exact).norm() / exact.norm();
  }

  Plate plate_;
  BlockHessian H_;
  std::unique_ptr<EnergyTerm> term_;
  Points X_;
};

constexpr double difference_step = 2e-5;  // metres; edges are a tenth of a metre

TEST_P(EnergyDerivatives, GradientIsThatOfTheEnergyToSecondOrder) {
  const double error = gradient_error(difference_step);
  EXPECT_LE(error, 1e-5);
  EXPECT_LE(error, 0.3 * gradient_error(2 * difference_step) + 1e-8);
}

TEST_P(EnergyDerivatives, HessianIsThatOfTheGradientToSecondOrder) {
  const double error = hessian_error(difference_step);
  EXPECT_LE(error, 1e-4);
  EXPECT_LE(error, 0.3 * hessian_error(2 * difference_step) + 1e-8);
}

TEST_P(EnergyDerivatives, PositivePartOfTheHessianIsPositive) {
  H_.clear();
  term_->add_hessian(X_, HessianPart::positive, H_);
  const Eigen::MatrixXd H = test::dense(H_);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(H, Eigen::EigenvaluesOnly);
  EXPECT_GE(solver.eigenvalues()[0], -1e-12 * solver.eigenvalues().tail(1)[0]);
}

std::vector<DerivativeCase> derivative_cases() {
  std::vector<DerivativeCase> cases;
  for (const test::TermRow& term : test::terms()) {
    for (const SheetMesh& mesh : sheet_meshes()) {
      for (const bool damped : {false, true}) {
        cases.push_back({term, mesh, damped});
      }
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Terms, EnergyDerivatives, testing::ValuesIn(derivative_cases()),
                         [](const auto& info) {
                           return fmt::format("{}_{}{}", info.param.term.name, info.param.mesh.name,
                                              info.param.damped ? "_damped" : "");
                         });

}  // namespace
}  // namespace ibmfair::cloth
