// Time and memory of sparse factorizations, for tools/solver_table and tools/ordering_table.
//
//   factorizations MESH SPLITS SOLVER ORDER THREADS
//
//     SPLITS    how often every triangle of the mesh is split into four
//     SOLVER    multifrontal, multifrontal32 (in float32), or cholmod
//     ORDER     default, minimum-degree or metis, the order that CHOLMOD asks METIS for
//     THREADS   of this library; the environment decides about those of the BLAS
//
// Prints an object of JSON with the name of the order, milliseconds to analyse, factor and solve
// (three right-hand sides), operations and entries, and megabytes in addition to the matrix.
#include <algorithm>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <cholmod.h>
#include <fmt/format.h>

#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/shapes/subdivide.h"
#include "ibmfair/solve/cholmod_cholesky.h"
#include "ibmfair/solve/multifrontal.h"
#include "ibmfair/solve/ordering.h"

namespace {

using namespace ibmfair;

/// I + the Laplacian of the graph of a crouzeix-raviart Jacobian over all vertices.
SymmetricMatrix example(const Topology& topology) {
  const auto energy = bending_model("crouzeix-raviart").create(topology, {});
  const StencilTerms terms(energy->stencils(), topology.vertex_count);
  const Unknowns all(std::vector<std::uint8_t>(topology.vertex_count, 0));
  SymmetricMatrix J = HessianAssembler(terms, all).pattern();
  std::fill(J.value.begin(), J.value.end(), -1);
  const CompressedRows graph = graph_of(J);
  for (Index j = 0; j < graph.size(); ++j) {
    J.value[J.column_first[j]] = 1 + static_cast<double>(graph[j].size());
  }
  return J;
}

/// The order that METIS finds for CHOLMOD.
EliminationOrder metis(SymmetricMatrix J) {
  cholmod_common common;
  cholmod_l_start(&common);
  cholmod_sparse A{};
  A.nrow = A.ncol = static_cast<std::size_t>(J.size());
  A.nzmax = J.row.size();
  A.p = J.column_first.data();
  A.i = J.row.data();
  A.stype = -1;
  A.itype = CHOLMOD_LONG;
  A.xtype = CHOLMOD_PATTERN;
  A.packed = 1;
  std::vector<std::int64_t> order(A.nrow);
  cholmod_l_metis(&A, nullptr, 0, 1, order.data(), &common);
  cholmod_l_finish(&common);
  return {"METIS", {order.begin(), order.end()}};
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

/// Prints the figures of one solver: `analyse` starts anew, `factor` and `solve` go on from there.
void measure(const SymmetricMatrix& J, const std::function<FactorForecast()>& analyse,
             const std::function<void()>& factor, const std::function<void(Points&)>& solve) {
  constexpr int few = 3, runs = 5;
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak so far is forgotten
  const double before = resident_bytes();
  FactorForecast forecast;
  const double analysis = milliseconds(few, [&] { forecast = analyse(); });
  const double factorization = milliseconds(runs, factor);
  Points Y = Points::Random(J.size(), 3);
  const double solution = milliseconds(runs, [&] { solve(Y); });
  fmt::print(R"({{"unknowns": {}, "order": "{}", "analyse": {}, "factor": {}, "solve": {}, )"
             R"("flops": {}, "entries": {}, "megabytes": {}}})"
             "\n",
             J.size(), forecast.ordering, analysis, factorization, solution, forecast.flops,
             forecast.factor_entries, (peak_resident_bytes() - before) / 1e6);
}

void measure_multifrontal(const SymmetricMatrix& J, const Points& X, const std::string& order,
                          Precision precision) {
  std::optional<MultifrontalAnalysis> analysis;
  std::optional<MultifrontalCholesky> cholesky;
  measure(
      J,
      [&] {
        cholesky.reset();
        if (order == "default") {
          analysis.emplace(J, X);
        } else {
          analysis.emplace(J);
        }
        return analysis->forecast();
      },
      [&] {
        if (!cholesky) cholesky.emplace(*analysis, precision);
        cholesky->factor(J);
      },
      [&](Points& Y) { cholesky->solve(Y, Y); });
}

void measure_cholmod(const SymmetricMatrix& J, const Points& X, const std::string& order) {
  std::optional<CholmodCholesky> cholesky;
  measure(
      J,
      [&] {
        cholesky.reset();
        if (order == "default") {
          cholesky.emplace(J, X);
        } else if (order == "metis") {
          cholesky.emplace(J, metis(J));
        } else {
          cholesky.emplace(J, EliminationOrder{"minimum degree", minimum_degree(graph_of(J))});
        }
        return cholesky->forecast();
      },
      [&] { cholesky->factor(J); }, [&](Points& Y) { cholesky->solve(Y, Y); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::cerr << "usage: factorizations MESH SPLITS SOLVER ORDER THREADS\n";
    return 2;
  }
  try {
    const std::string solver = argv[3], order = argv[4];
    set_thread_count(std::stoi(argv[5]));
    SymmetricMatrix J;
    Points X;
    {
      const MeshFile file = read_mesh(argv[1]);
      TriangleMesh mesh{file.mesh().X, triangulate(file.mesh()).F};
      for (int split = 0; split < std::stoi(argv[2]); ++split) {
        mesh = split_all_triangles(mesh);
      }
      X = mesh.X;
      J = example(build_topology(X, mesh.F));
    }
    if (solver == "cholmod") {
      measure_cholmod(J, X, order);
    } else {
      const bool single = solver == "multifrontal32";
      measure_multifrontal(J, X, order, single ? Precision::float32 : Precision::float64);
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
