// The multifrontal factorization solves every system of the flow to its precision.
#include "ibmfair/solve/multifrontal.h"

#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/shapes/shapes.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The matrix I + S of a mesh: symmetric positive definite, with the pattern that the matrices of
/// the flow have.
SymmetricMatrix example(const State& state) {
  const auto energy = bending_model("lagrange").create(state.topology, {});
  const StencilTerms terms(energy->stencils(), state.topology.vertex_count);
  const HessianAssembler assembler(terms, Unknowns(std::vector<std::uint8_t>(state.X.rows(), 0)));
  SymmetricMatrix J = assembler.pattern();
  StencilWeights weights;
  energy->linearise(state.X, weights);
  assembler.assemble(weights, J);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    J.value[J.column_first[j]] += 1;
  }
  return J;
}

TEST(Multifrontal, Solves) {
  for (const auto& [name, mesh] : all_meshes()) {
    const SymmetricMatrix J = example(State(mesh));
    const Points X = random_directions(J.size());
    const MultifrontalAnalysis analysis(J);
    EXPECT_GE(analysis.forecast().factor_entries, static_cast<double>(J.size())) << name;
    MultifrontalCholesky cholesky(analysis);
    cholesky.factor(J);
    Points Y;
    cholesky.solve(multiply(J, X), Y);
    EXPECT_LT((Y - X).norm(), 1e-8 * X.norm()) << name;
  }
}

/// The positions that are given for the unknowns affect the ordering only, not the solution.
TEST(Multifrontal, SolvesWhereItDissects) {
  const State state(make_shape("icosphere", {.subdivide = 5}));
  const SymmetricMatrix J = example(state);
  const Points B = random_directions(J.size());
  for (const Points& X :
       {state.X, Points(Points::Zero(J.size(), 3)), random_directions(J.size())}) {
    const MultifrontalAnalysis analysis(J, X);
    EXPECT_EQ(analysis.forecast().ordering, "nested dissection");
    MultifrontalCholesky cholesky(analysis);
    cholesky.factor(J);
    Points Y;
    cholesky.solve(multiply(J, B), Y);
    EXPECT_LT((Y - B).norm(), 1e-8 * B.norm());
  }
}

/// For n unknowns on a surface, a factor ordered by nested dissection has n log n entries and takes
/// n^1.5 operations.
TEST(Multifrontal, FactorsGrowAsThoseOfSurfaces) {
  const auto expect_growth = [](const Mesh& coarse, const Mesh& fine) {
    std::vector<FactorForecast> forecasts;
    for (const Mesh& mesh : {coarse, fine}) {
      const State state(mesh);
      const SymmetricMatrix J = example(state);
      forecasts.push_back(MultifrontalAnalysis(J, state.X).forecast());
      const FactorForecast by_degree = MultifrontalAnalysis(J).forecast();
      EXPECT_LT(forecasts.back().flops, 0.85 * by_degree.flops);
      EXPECT_LT(forecasts.back().factor_entries, by_degree.factor_entries);
    }
    EXPECT_LT(forecasts[1].flops, 10 * forecasts[0].flops);
    EXPECT_LT(forecasts[1].factor_entries, 5.3 * forecasts[0].factor_entries);
  };
  expect_growth(make_shape("icosphere", {.subdivide = 5}),
                make_shape("icosphere", {.subdivide = 6}));
  expect_growth(make_shape("torus", {.rows = 96}), make_shape("torus", {.rows = 192}));
}

TEST(Multifrontal, Float32SolvesToItsPrecisionWhateverTheScaleOfTheRows) {
  for (const auto& [name, mesh] : all_meshes()) {
    SymmetricMatrix J = example(State(mesh));
    for (double scale : {1e-30, 1.0, 1e30}) {
      SymmetricMatrix scaled = J;
      for (double& value : scaled.value) {
        value *= scale;
      }
      const MultifrontalAnalysis analysis(scaled);
      MultifrontalCholesky cholesky(analysis, Precision::float32);
      cholesky.factor(scaled);
      const Points X = random_directions(J.size());
      Points Y;
      cholesky.solve(multiply(scaled, X), Y);
      EXPECT_LT((multiply(J, Y) - multiply(J, X)).norm(), 1e-4 * multiply(J, X).norm()) << name;
    }
  }
}

TEST(Multifrontal, SolvesToTheSameBytesForAnyNumberOfThreads) {
  const State state(make_shape("icosphere", {.subdivide = 5}));
  const SymmetricMatrix J = example(state);
  const Points B = random_directions(J.size());
  for (const Precision precision : {Precision::float32, Precision::float64}) {
    std::vector<Points> solutions(3);
    for (const int threads : {1, 2, 3}) {
      set_thread_count(threads);
      const MultifrontalAnalysis analysis(J, state.X);
      MultifrontalCholesky cholesky(analysis, precision);
      cholesky.factor(J);
      cholesky.solve(B, solutions[threads - 1]);
    }
    set_thread_count(0);
    EXPECT_EQ(solutions[0], solutions[1]);
    EXPECT_EQ(solutions[0], solutions[2]);
  }
}

TEST(Multifrontal, RefactorsOtherValuesInPlaceAndSolvesInPlace) {
  SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  const MultifrontalAnalysis analysis(J);
  MultifrontalCholesky cholesky(analysis);
  const Points X = random_directions(J.size());
  for (int round = 0; round < 3; ++round) {
    for (double& value : J.value) {
      value *= 2;
    }
    cholesky.factor(J);
    Points Y = multiply(J, X);
    cholesky.solve(Y, Y);
    EXPECT_LT((Y - X).norm(), 1e-9 * X.norm());
  }
}

TEST(Multifrontal, OneAnalysisServesSeveralFactors) {
  const SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  SymmetricMatrix K = J;
  for (double& value : K.value) {
    value *= 3;
  }
  const MultifrontalAnalysis analysis(J);
  MultifrontalCholesky first(analysis), second(analysis);
  first.factor(J);
  second.factor(K);
  const Points X = random_directions(J.size());
  Points Y, Z;
  first.solve(X, Y);
  second.solve(X, Z);
  EXPECT_LT((Y - 3 * Z).norm(), 1e-10 * Y.norm());
}

TEST(Multifrontal, NamesTheUnknownAtWhichAMatrixIsNotPositiveDefinite) {
  SymmetricMatrix J = example(State(closed_meshes()[3].mesh));
  const MultifrontalAnalysis analysis(J);
  MultifrontalCholesky cholesky(analysis);
  J.value[J.column_first[17]] = -1;
  try {
    cholesky.factor(J);
    FAIL();
  } catch (const FactorizationFailed& error) {
    EXPECT_NE(std::string(error.what()).find("not positive definite"), std::string::npos);
  }
  // The symbolic analysis can still be used for a matrix that is positive definite.
  J.value[J.column_first[17]] = 1e6;
  EXPECT_NO_THROW(cholesky.factor(J));
}

}  // namespace
}  // namespace ibmfair::test
