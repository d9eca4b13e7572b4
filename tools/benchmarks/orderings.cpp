// Costs and savings of elimination orders, for tools/ordering_table.
//
//   orderings MESH SPLITS   splits every triangle of the mesh into four SPLITS times, and prints a
//                           line of JSON for each order: its name, milliseconds to analyse, factor
//                           (float64) and solve, and millions of operations and entries
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <cholmod.h>
#include <fmt/format.h>

#include "ibmfair/base/stopwatch.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/subdivide.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/ordering.h"

namespace {

using namespace ibmfair;

/// I + the Laplacian of the graph of a crouzeix-raviart Jacobian over all vertices.
SymmetricMatrix example(const Topology& topology) {
  const auto energy = bending_model("crouzeix-raviart").bind(topology, {});
  const StencilTerms terms(energy->stencils(), topology.vertex_count);
  const Unknowns all(std::vector<std::uint8_t>(topology.vertex_count, 0));
  SymmetricMatrix J = HessianAssembler(terms, all).pattern();
  std::fill(J.value.begin(), J.value.end(), -1);
  const Rows graph = graph_of(J);
  for (Index j = 0; j < graph.size(); ++j) {
    J.value[J.column_first[j]] = 1 + static_cast<double>(graph[j].size());
  }
  return J;
}

/// The shortest time of a few runs, milliseconds.
double milliseconds(int runs, const std::function<void()>& action) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    double seconds = 0;
    {
      const Stopwatch watch(seconds);
      action();
    }
    least = std::min(least, 1000 * seconds);
  }
  return least;
}

void tell(const std::function<MultifrontalAnalysis()>& analyse, const SymmetricMatrix& J,
          const Points& B) {
  constexpr int runs = 5;
  const double analysing = milliseconds(runs, [&] { analyse(); });
  const MultifrontalAnalysis analysis = analyse();
  MultifrontalCholesky cholesky(analysis);
  const double factorization = milliseconds(runs, [&] { cholesky.factor(J); });
  Points Y;
  const double solve = milliseconds(runs, [&] { cholesky.solve(B, Y); });
  const FactorForecast& forecast = analysis.forecast();
  fmt::print(R"({{"order": "{}", "analyse": {}, "factor": {}, "solve": {}, "flops": {}, )"
             R"("entries": {}}})"
             "\n",
             forecast.ordering, analysing, factorization, solve, forecast.flops / 1e6,
             forecast.factor_entries / 1e6);
}

/// CHOLMOD's own analysis with METIS, whose order this library does not use.
void tell_metis(SymmetricMatrix J) {
  cholmod_common common;
  cholmod_l_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  cholmod_sparse A{};
  A.nrow = A.ncol = static_cast<std::size_t>(J.size());
  A.nzmax = J.row.size();
  A.p = J.column_first.data();
  A.i = J.row.data();
  A.stype = -1;
  A.itype = CHOLMOD_LONG;
  A.xtype = CHOLMOD_PATTERN;
  A.packed = 1;
  const double analysis = milliseconds(2, [&] {
    cholmod_factor* factor = cholmod_l_analyze(&A, &common);
    cholmod_l_free_factor(&factor, &common);
  });
  fmt::print(R"({{"order": "METIS", "analyse": {}, "flops": {}, "entries": {}}})"
             "\n",
             analysis, common.fl / 1e6, common.lnz / 1e6);
  cholmod_l_finish(&common);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: orderings MESH SPLITS\n";
    return 2;
  }
  try {
    const MeshFile file = read_mesh(argv[1]);
    TriangleMesh mesh{file.mesh().X, triangulate(file.mesh()).F};
    for (int split = 0; split < std::stoi(argv[2]); ++split) {
      mesh = split_all_triangles(mesh);
    }
    const Points& X = mesh.X;
    const SymmetricMatrix J = example(build_topology(X, mesh.F));
    fmt::print(R"({{"unknowns": {}}})"
               "\n",
               J.size());
    tell([&] { return MultifrontalAnalysis(J); }, J, X);
    tell([&] { return MultifrontalAnalysis(J, X); }, J, X);
    tell_metis(J);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
