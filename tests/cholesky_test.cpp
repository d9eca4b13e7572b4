#include "ibmfair/solve/cholesky.h"

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/hessian.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// I + S of a mesh: symmetric positive definite, with the pattern that the flow has.
SymmetricMatrix example(const State& state) {
  const auto energy = bending_model("lagrange").bind(state.topology, {});
  const HessianAssembler assembler(energy->stencils(),
                                   Unknowns(std::vector<std::uint8_t>(state.X.rows(), 0)));
  SymmetricMatrix J = assembler.pattern();
  StencilWeights weights;
  energy->linearise(state.X, weights);
  assembler.assemble(weights, J);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    J.value[J.column_first[j]] += 1;
  }
  return J;
}

Points multiply(const SymmetricMatrix& J, const Points& X) {
  Points B = Points::Zero(X.rows(), 3);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    for (std::int64_t k = J.column_first[j]; k < J.column_first[j + 1]; ++k) {
      B.row(J.row[k]) += J.value[k] * X.row(j);
      if (J.row[k] != j) {
        B.row(j) += J.value[k] * X.row(J.row[k]);
      }
    }
  }
  return B;
}

TEST(Cholesky, SolvesUnderEveryOrdering) {
  for (const auto& [name, mesh] : all_meshes()) {
    const SymmetricMatrix J = example(State(mesh));
    const Points X = random_directions(J.size());
    for (const Ordering ordering : {Ordering::automatic, Ordering::amd, Ordering::metis}) {
      const SymbolicCholesky symbolic(J, ordering);
      EXPECT_GE(symbolic.forecast().factor_entries, static_cast<double>(J.size())) << name;
      CholeskyFactor factor(symbolic);
      factor.factor(J);
      CholeskySolver solver(factor);
      Points Y;
      solver.solve(multiply(J, X), Y);
      EXPECT_LT((Y - X).norm(), 1e-8 * X.norm()) << name;
    }
  }
}

TEST(Cholesky, RefactorsOtherValuesInPlaceAndSolvesInPlace) {
  SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  const SymbolicCholesky symbolic(J);
  CholeskyFactor factor(symbolic);
  CholeskySolver solver(factor);
  const Points X = random_directions(J.size());
  for (int round = 0; round < 3; ++round) {
    for (double& value : J.value) {
      value *= 2;
    }
    factor.factor(J);
    Points Y = multiply(J, X);
    solver.solve(Y, Y);
    EXPECT_LT((Y - X).norm(), 1e-9 * X.norm());
  }
}

TEST(Cholesky, OneAnalysisServesSeveralFactors) {
  const SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  SymmetricMatrix K = J;
  for (double& value : K.value) {
    value *= 3;
  }
  const SymbolicCholesky symbolic(J);
  CholeskyFactor first(symbolic), second(symbolic);
  first.factor(J);
  second.factor(K);
  const Points X = random_directions(J.size());
  Points Y, Z;
  CholeskySolver(first).solve(X, Y);
  CholeskySolver(second).solve(X, Z);
  EXPECT_LT((Y - 3 * Z).norm(), 1e-10 * Y.norm());
}

TEST(Cholesky, NamesTheUnknownAtWhichAMatrixIsNotPositiveDefinite) {
  SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  const SymbolicCholesky symbolic(J);
  CholeskyFactor factor(symbolic);
  J.value[J.column_first[17]] = -1;
  try {
    factor.factor(J);
    FAIL();
  } catch (const FactorizationFailed& error) {
    EXPECT_NE(std::string(error.what()).find("not positive definite"), std::string::npos);
  }
  // The analysis is still good for a matrix that is.
  J.value[J.column_first[17]] = 1e6;
  EXPECT_NO_THROW(factor.factor(J));
}

}  // namespace
}  // namespace ibmfair::test
