#include "ibmfair/fill/linear_fairing.h"

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair {

void fair_linearly(Patch& patch) {
  if (patch.own_size() == 0) {
    return;
  }
  const Topology topology = build_topology(patch.X, all_triangles(patch));
  EnergyOptions options;
  std::vector<std::uint8_t> fixed(static_cast<std::size_t>(patch.size()), 1);
  std::fill(fixed.begin() + patch.own_from, fixed.end(), 0);
  options.active.assign(fixed.size(), 0);
  std::fill(options.active.begin() + patch.own_from, options.active.end(), 1);
  const auto energy = bending_model("lagrange").create(topology, options);
  StencilWeights weights;
  energy->linearise(patch.X, weights);
  const StencilTerms terms(energy->stencils(), patch.size());
  const HessianAssembler assembler(terms, Unknowns(fixed));
  SymmetricMatrix S = assembler.pattern();
  assembler.assemble(weights, S);
  Points residual = Points::Zero(patch.own_size(), 3);
  for (Index v = patch.own_from; v < patch.size(); ++v) {
    terms.for_terms(v, weights, [&](Index w, double value) {
      residual.row(v - patch.own_from) += value * patch.X.row(w);
    });
  }
  MultifrontalCholesky cholesky{MultifrontalAnalysis(S)};
  cholesky.factor(S);
  cholesky.solve(residual, residual);
  patch.X.bottomRows(patch.own_size()) -= residual;
}

}  // namespace ibmfair
