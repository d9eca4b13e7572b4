// The stages of `ibmfair smooth` one by one, each as a function that can be repeated.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/solve/conjugate_gradients.h"
#include "ibmfair/solve/multifrontal.h"

namespace ibmfair::benchmarks {

/// The results of the stages; each stage computes its results as if for the first time.
struct StageResults {
  std::optional<MeshFile> file;
  std::optional<Topology> topology;
  std::unique_ptr<BendingEnergy> bending;
  std::unique_ptr<StencilTerms> terms;
  std::unique_ptr<HessianAssembler> assembler;
  SymmetricMatrix matrix;
  std::optional<MultifrontalAnalysis> analysis;
  std::optional<MultifrontalCholesky> cholesky;
};

/// One mesh with the inputs of all stages. The Jacobian is that of a flow by
/// crouzeix-raviart in the mass metric over all vertices, one of 16 steps to a cut-off of eight
/// mean edge lengths.
struct StageInputs {
  /// Reads the mesh and prepares every stage. Throws as the library does.
  StageInputs(std::string input_path, std::string output_path);

  std::string path, output;  ///< the mesh; the file that the stage `write` writes
  MeshFile file;
  Points X;
  Points moved;  ///< other positions of all vertices
  Topology topology;
  std::unique_ptr<BendingEnergy> crouzeix_raviart, lagrange;
  Unknowns unknowns;
  StencilTerms terms;
  HessianAssembler assembler;
  StencilWeights weights;
  SymmetricMatrix J;
  double written_bytes = 0;

  double analysis_seconds = 0;
  std::optional<MultifrontalAnalysis> analysis;
  /// Empty if factoring would take too long or too much memory, or if floats do not suffice.
  std::optional<MultifrontalCholesky> cholesky, float_cholesky;
  JacobianRows rows;
  ConjugateGradients iteration;
  double h = 0;
  PerVertex mass;
  Points B, Y, G;

  StageResults results;
};

/// A row of the table of stages.
struct Stage {
  std::string_view name;
  void (*run)(StageInputs& inputs);  ///< `inputs.results` must be empty before
  /// The bytes that any implementation must read and write; null if `flops` counts instead.
  double (*bytes)(const StageInputs& inputs);
  double (*flops)(const StageInputs& inputs) = nullptr;
  /// Whether the stage can be run for this mesh; null: for every one.
  bool (*possible)(const StageInputs& inputs) = nullptr;
};

/// All stages, in the order of a run.
std::span<const Stage> stages();

}  // namespace ibmfair::benchmarks
