// The iterative solver: the Jacobian by rows, conjugate gradients, and the flow that uses them.
#include "ibmfair/solve/conjugate_gradients.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/shapes/shapes.h"
#include "support/kernel_sets.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

/// The matrix J = D + h S of a shaken mesh, with every third vertex fixed or with no vertex fixed,
/// both by rows and assembled.
struct Example {
  Example(const State& state, std::string_view model, bool hold)
      : energy(bending_model(model).create(state.topology, {})),
        terms(energy->stencils(), state.topology.vertex_count),
        unknowns([&] {
          std::vector<std::uint8_t> fixed(state.X.rows(), 0);
          for (std::size_t v = 0; hold && v < fixed.size(); v += 3) {
            fixed[v] = 1;
          }
          return Unknowns(fixed);
        }()) {
    energy->linearise(shaken(state, 0.1), weights);
    D = Eigen::VectorXd::LinSpaced(unknowns.size(), 1, 3);
    const HessianAssembler assembler(terms, unknowns);
    J = assembler.pattern();
    assembler.assemble(weights, J);
    double largest = 0;
    for (std::int64_t j = 0; j < J.size(); ++j) {
      largest = std::max(largest, J.value[J.column_first[j]]);
    }
    h = largest > 0 ? 100 / largest : 1;  // a condition of about a hundred
    for (double& value : J.value) {
      value *= h;
    }
    for (std::int64_t j = 0; j < J.size(); ++j) {
      J.value[J.column_first[j]] += D[j];
    }
    rows = std::make_unique<JacobianRows>(terms, unknowns);
    rows->update(weights, D, h);
  }

  /// sqrt(<B, diag(J)^-1 B>)
  double norm(const Points& B) const {
    double squared = 0;
    for (std::int64_t j = 0; j < J.size(); ++j) {
      squared += B.row(j).squaredNorm() / J.value[J.column_first[j]];
    }
    return std::sqrt(squared);
  }

  std::unique_ptr<BendingEnergy> energy;
  StencilTerms terms;
  Unknowns unknowns;
  StencilWeights weights;
  Eigen::VectorXd D;
  double h = 1;
  SymmetricMatrix J;
  std::unique_ptr<JacobianRows> rows;
};

/// The product J X by rows for three random columns X, and <X, J X>.
struct RowProduct {
  explicit RowProduct(const Example& example) {
    Quads p = Quads::Zero(4, example.J.size()), q(4, p.cols());
    p.topRows(3) = random_directions(p.cols()).transpose().cast<float>();
    curvature = example.rows->unit() * example.rows->apply(p, q);
    Y = example.rows->unit() * q.topRows(3).cast<double>().transpose().matrix();
  }
  Points Y;
  double curvature = 0;
};

void expect_the_assembled_product(const Example& example) {
  const Points X = random_directions(example.J.size()), exact = multiply(example.J, X);
  const RowProduct product(example);
  EXPECT_LE((product.Y - exact).norm(), 1e-5 * exact.norm());
  const double curvature = X.cwiseProduct(exact).sum();
  EXPECT_NEAR(product.curvature, curvature, 1e-5 * curvature);
}

template <class Check>
void for_every_example(const Check& check) {
  for (const BendingModel& model : bending_models()) {
    for (const Placement placement : all_placements) {
      for (const auto& [name, mesh] : placed(all_meshes(), placement)) {
        for (const bool hold : {false, true}) {
          SCOPED_TRACE(std::string(model.name) + ", " + name + (hold ? ", some fixed" : ""));
          Example example(State(mesh), model.name, hold);
          check(example);
        }
      }
    }
  }
}

TEST(JacobianRows, MultiplyAsTheAssembledMatrixDoes) {
  for_every_example(expect_the_assembled_product);
}

TEST(JacobianRows, SeeNothingButTheMetricInConstants) {
  for_every_example([](const Example& example) {
    if (example.unknowns.size() < static_cast<Index>(example.unknowns.unknown.size())) {
      return;
    }
    const Quads p = Quads::Constant(4, example.unknowns.size(), 1);
    Quads q(4, p.cols());
    example.rows->apply(p, q);
    for (Index u = 0; u < p.cols(); ++u) {
      EXPECT_EQ(q(0, u), static_cast<float>(example.D[u] / example.rows->unit()));
    }
  });
}

TEST(JacobianRows, MayHaveManyColumns) {
  for (const bool hold : {false, true}) {
    expect_the_assembled_product(Example(State(barrel(300)), "crouzeix-raviart", hold));
  }
}

TEST(JacobianRows, KnowNoScale) {
  for_every_example([](Example& example) {
    const Points before = RowProduct(example).Y;
    for (const double scale : {std::exp2(200), std::exp2(-200)}) {
      example.rows->update(example.weights, scale * example.D, scale * example.h);
      EXPECT_EQ(RowProduct(example).Y, scale * before);
    }
  });
}

TEST(JacobianRows, RefuseWhatIsNotPositive) {
  const State state(Mesh(make_shape("icosphere", {})));
  Example example(state, "lagrange", false);
  example.weights.c[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(example.rows->update(example.weights, example.D, example.h), FactorizationFailed);
}

TEST(ConjugateGradients, Avx2GivesTheBytesOfTheBaseline) {
  SKIP_WITHOUT_KERNEL_SET(InstructionSet::avx2);
  for_every_example([](const Example& example) {
    const Points B = random_directions(example.J.size());
    ConjugateGradients solver(*example.rows);
    const auto solve = [&](InstructionSet set, Points& Y) {
      const WithKernelSet chosen(set);
      return solver.solve(B, Y, 1e-3, 1000);
    };
    Points baseline, avx2;
    const int iterations = solve(InstructionSet::baseline, baseline);
    EXPECT_EQ(solve(InstructionSet::avx2, avx2), iterations);
    EXPECT_EQ(avx2, baseline);
  });
}

/// First guesses that Y may hold before the solver runs: nothing, unrelated values, values near a
/// multiple of the solution, the negative solution, zeros, and NaN.
std::vector<Points> guesses(const Example& example, const Points& B) {
  Points solution;
  ConjugateGradients(*example.rows).solve(B, solution, 1e-4, 1000);
  const Points other = random_directions(B.rows() + 1).bottomRows(B.rows());
  const double scale = 0.01 * solution.norm() / other.norm();
  return {Points(),
          other,
          1e6 * (solution + scale * other),
          -solution,
          Points::Zero(B.rows(), 3),
          Points::Constant(B.rows(), 3, std::numeric_limits<double>::quiet_NaN())};
}

TEST(ConjugateGradients, SolveToTheTolerance) {
  for_every_example([](const Example& example) {
    const Points B = random_directions(example.J.size());
    ConjugateGradients solver(*example.rows);
    for (const double tolerance : {1e-1, 1e-3}) {
      for (Points Y : guesses(example, B)) {
        EXPECT_LT(solver.solve(B, Y, tolerance, 1000), 200);
        const Points residual = B - multiply(example.J, Y);
        EXPECT_LE(example.norm(residual), 1.05 * tolerance * example.norm(B));
      }
    }
  });
}

// The guard of the flow relies on this law.
TEST(ConjugateGradients, StopAtAMinimumAlongTheirStep) {
  for_every_example([](const Example& example) {
    const Points B = random_directions(example.J.size());
    ConjugateGradients solver(*example.rows);
    for (const int iterations : {1, 2, 5}) {
      for (Points d : guesses(example, B)) {
        EXPECT_LE(solver.solve(B, d, 1e-12, iterations), iterations);
        const double slope = d.cwiseProduct(B).sum();
        EXPECT_GT(slope, 0);
        EXPECT_NEAR(d.cwiseProduct(multiply(example.J, d)).sum(), slope, 1e-4 * slope);
      }
    }
  });
}

TEST(ConjugateGradients, TakeFewerIterationsFromNearBy) {
  ShapeSettings settings;
  settings.subdivide = 4;
  const Example example(State(Mesh(make_shape("icosphere", settings))), "crouzeix-raviart", false);
  const Points B = random_directions(example.J.size()), towards = random_directions(B.rows());
  ConjugateGradients solver(*example.rows);
  Points Y, next;
  solver.solve(B, Y, 1e-3, 1000);
  const Points like_B = 0.7 * B + 0.02 * towards;
  const int from_zero = solver.solve(like_B, next, 0.05, 1000);
  EXPECT_LT(2 * solver.solve(like_B, Y, 0.05, 1000), from_zero);
}

TEST(ConjugateGradients, TurnWithWhatTheySolveFor) {
  for_every_example([](const Example& example) {
    const Points B = random_directions(example.J.size());
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    ConjugateGradients solver(*example.rows);
    Points Y, turned;
    solver.solve(B, Y, 1e-12, 4);
    solver.solve(B * R, turned, 1e-12, 4);
    EXPECT_LT((Y * R - turned).norm(), 1e-5 * Y.norm());
  });
}

TEST(ConjugateGradients, HaveNothingToDoForZero) {
  const State state(Mesh(make_shape("icosphere", {})));
  const Example example(state, "crouzeix-raviart", true);
  Points Y;
  EXPECT_EQ(ConjugateGradients(*example.rows)
                .solve(Points::Zero(example.unknowns.size(), 3), Y, 1e-3, 10),
            0);
  EXPECT_EQ(Y, Points::Zero(example.unknowns.size(), 3));
}

TEST(ConjugateGradients, GiveTheSameBytesForAnyNumberOfThreads) {
  ShapeSettings settings;
  settings.subdivide = 6;
  const State state(Mesh(make_shape("icosphere", settings)));
  Points first;
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    const Example example(state, "crouzeix-raviart", true);
    Points Y;
    ConjugateGradients(*example.rows).solve(random_directions(example.J.size()), Y, 1e-3, 100);
    if (threads == 1) {
      first = Y;
    }
    EXPECT_EQ(Y, first);
  }
  set_thread_count(0);
}

// The result of conjugate gradients is as near to the sphere as the result of Cholesky, and the two
// results are nearer to each other than to the sphere.
TEST(ConjugateGradients, TakeTheFlowWhereCholeskyDoes) {
  ShapeSettings settings;
  settings.subdivide = 4;
  const State state(Mesh(make_shape("icosphere", settings)));
  for (const BendingModel& model : bending_models()) {
    const auto ended = [&](const char* solver) {
      Points X = shaken(state, 0.2);
      FlowOptions options;
      options.laplacian = model.name;
      options.solver = solver;
      const double edge = mean_edge_length(state.X, state.topology.E);
      options.total_time =
          time_in_flow_units(time_for_cutoff(8 * edge), state.X, state.topology, options);
      const FlowReport report =
          willmore_flow(X, state.topology, std::vector<std::uint8_t>(X.rows(), 0), options);
      EXPECT_EQ(report.solver, solver);
      return X;
    };
    const Points by_cg = ended("cg"), by_factor = ended("multifrontal");
    const auto roughness = [](const Points& X) {
      return std::sqrt((X.rowwise().norm().array() - 1).square().mean());
    };
    EXPECT_LT(roughness(by_cg), 1.1 * roughness(by_factor)) << model.name;
    EXPECT_LT((by_cg - by_factor).norm() / std::sqrt(double(state.X.rows())), roughness(by_factor))
        << model.name;
  }
}

}  // namespace
}  // namespace ibmfair::test
