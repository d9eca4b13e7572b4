// The Hessian of the energy agrees with the energy, is positive semi-definite, and annihilates
// constants.
#include "ibmfair/energy/hessian.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "support/family.h"
#include "support/meshes.h"
#include "support/states.h"

namespace ibmfair::test {
namespace {

SymmetricMatrix assemble(BendingEnergy& energy, const Points& X, const Unknowns& unknowns) {
  const StencilTerms terms(energy.stencils(), static_cast<Index>(X.rows()));
  const HessianAssembler assembler(terms, unknowns);
  SymmetricMatrix S = assembler.pattern();
  StencilWeights weights;
  energy.linearise(X, weights);
  assembler.assemble(weights, S);
  return S;
}

template <class Check>
void for_every_hessian(const Check& check) {
  for (const Member& member : family()) {
    for (const auto& [name, mesh] : all_meshes()) {
      const State state(mesh);
      if (state.X.rows() > 800) {
        continue;  // dense matrices are for small meshes
      }
      const auto energy = member.create(state.topology);
      const Points X = shaken(state, 0.05);
      const Unknowns all(std::vector<std::uint8_t>(X.rows(), 0));
      SCOPED_TRACE(identifier(member) + ", " + name);
      check(member, *energy, X, dense(assemble(*energy, X, all)));
    }
  }
}

TEST(Hessian, AnnihilatesConstants) {
  for_every_hessian([](const Member&, BendingEnergy&, const Points&, const Eigen::MatrixXd& S) {
    EXPECT_LE(S.rowwise().sum().cwiseAbs().maxCoeff(), 1e-11 * S.cwiseAbs().maxCoeff());
  });
}

TEST(Hessian, HalfTheQuadraticFormIsTheEnergyAtTheReference) {
  for_every_hessian(
      [](const Member& member, BendingEnergy& energy, const Points& X, const Eigen::MatrixXd& S) {
        const double E = energy.energy(X), form = (X.transpose() * S * X).trace() / 2;
        if (member.has_own_hessian()) {
          EXPECT_NEAR(form, E, 1e-9 * E + 1e-14);
        } else if (member.mass == "galerkin") {  // its inverse is within a factor of two
          EXPECT_LE(form, (2 + 1e-9) * E + 1e-14);
          EXPECT_GE(form, (0.5 - 1e-9) * E - 1e-14);
        }
      });
}

TEST(Hessian, IsPositiveSemiDefinite) {
  for_every_hessian([](const Member&, BendingEnergy&, const Points&, const Eigen::MatrixXd& S) {
    if (S.rows() <= 200) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(S, Eigen::EigenvaluesOnly);
      EXPECT_GE(solver.eigenvalues()[0], -1e-10 * solver.eigenvalues().tail(1)[0]);
    }
  });
}

TEST(Hessian, OfTheUnknownsIsTheBlockOfTheWhole) {
  for (const BendingModel& model : bending_models()) {
    const State state(closed_meshes().front().mesh);
    const auto energy = model.create(state.topology, {});
    std::vector<std::uint8_t> fixed(state.X.rows(), 0);
    fixed[1] = fixed[2] = 1;
    const Unknowns some(fixed), all(std::vector<std::uint8_t>(fixed.size(), 0));
    const Eigen::MatrixXd whole = dense(assemble(*energy, state.X, all));
    EXPECT_EQ(dense(assemble(*energy, state.X, some)),
              Eigen::MatrixXd(whole(some.vertex, some.vertex)))
        << model.name;
  }
}

TEST(Hessian, IsTheSumOverTheStencils) {
  for (const Mesh& mesh : {all_meshes().front().mesh, barrel(300)}) {  // rows of hundreds
    const State state(mesh);
    for (const Member& member : family()) {
      const auto energy = member.create(state.topology);
      StencilWeights weights;
      energy->linearise(shaken(state, 0.05), weights);
      const CompressedRows& stencils = energy->stencils();
      Eigen::MatrixXd S = Eigen::MatrixXd::Zero(state.X.rows(), state.X.rows());
      for (Index s = 0; s < stencils.size(); ++s) {
        for (std::int64_t k = stencils.first[s]; k < stencils.first[s + 1]; ++k) {
          for (std::int64_t l = stencils.first[s]; l < stencils.first[s + 1]; ++l) {
            S(stencils.value[k], stencils.value[l]) += weights.w[s] * weights.c[k] * weights.c[l];
          }
        }
      }
      const Unknowns all(std::vector<std::uint8_t>(state.X.rows(), 0));
      const Eigen::MatrixXd assembled = dense(assemble(*energy, shaken(state, 0.05), all));
      EXPECT_LE((assembled - S).cwiseAbs().maxCoeff(), 1e-13 * S.cwiseAbs().maxCoeff())
          << identifier(member);
      const StencilTerms terms(stencils, state.topology.vertex_count);
      for (Index v = 0; v < state.topology.vertex_count; ++v) {
        EXPECT_NEAR(terms.diagonal(v, weights), S(v, v), 1e-13 * S(v, v)) << identifier(member);
      }
    }
  }
}

TEST(Hessian, RefillingDoesNotRememberTheOldValues) {
  for (const BendingModel& model : bending_models()) {
    const State state(closed_meshes()[3].mesh);
    const auto energy = model.create(state.topology, {});
    const Unknowns all(std::vector<std::uint8_t>(state.X.rows(), 0));
    const StencilTerms terms(energy->stencils(), state.topology.vertex_count);
    const HessianAssembler assembler(terms, all);
    SymmetricMatrix S = assembler.pattern();
    StencilWeights weights;
    for (const double amount : {0.05, 0.0}) {
      energy->linearise(shaken(state, amount), weights);
      assembler.assemble(weights, S);
    }
    EXPECT_EQ(S.value, assemble(*energy, state.X, all).value) << model.name;
  }
}

}  // namespace
}  // namespace ibmfair::test
