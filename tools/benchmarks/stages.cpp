#include "stages.h"

#include <array>
#include <utility>

#include <unistd.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/io/source_bytes.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::benchmarks {
namespace {

constexpr double longest_stage = 60;        // seconds
constexpr double slow_factorization = 5e9;  // flops a second
constexpr double share_of_memory = 0.7;

void read(StageInputs& s) {
  s.results.file = read_mesh(s.path);
}

void build(StageInputs& s) {
  s.results.topology = build_topology(s.X, triangulate(s.file.mesh()).F);
}

/// The blocks over which an energy is summed.
void create(StageInputs& s) {
  s.results.bending = bending_model("crouzeix-raviart").create(s.topology, {});
}

void make_pattern(StageInputs& s) {
  s.results.terms =
      std::make_unique<StencilTerms>(s.crouzeix_raviart->stencils(), s.topology.vertex_count);
  s.results.assembler = std::make_unique<HessianAssembler>(*s.results.terms, s.unknowns);
  s.results.matrix = s.results.assembler->pattern();
}

/// J = M + h S, [W07] (13).
void assemble(StageInputs& s) {
  s.crouzeix_raviart->linearise(s.X, s.weights);
  s.assembler.assemble(s.weights, s.J);
  s.mass = lumped_vertex_mass(s.X, s.topology);
  s.h = time_for_cutoff(8 * mean_edge_length(s.X, s.topology.E)) / 16;
  for (double& entry : s.J.value) {
    entry *= s.h;
  }
  for (Index u = 0; u < s.unknowns.size(); ++u) {
    s.J.value[s.J.column_first[u]] += s.mass[s.unknowns.vertex[u]];
  }
}

void analyse(StageInputs& s) {
  s.results.analysis.emplace(s.J, s.X);
}

/// The first factorization of a run, its allocation included.
void factor(StageInputs& s) {
  s.results.cholesky.emplace(*s.analysis, Precision::float64);
  s.results.cholesky->factor(s.J);
}

void factor_in_floats(StageInputs& s) {
  s.results.cholesky.emplace(*s.analysis, Precision::float32);
  s.results.cholesky->factor(s.J);
}

void solve(StageInputs& s) {
  s.cholesky->solve(s.B, s.Y);
}

void solve_in_floats(StageInputs& s) {
  s.float_cholesky->solve(s.B, s.Y);
}

void assemble_rows(StageInputs& s) {
  s.crouzeix_raviart->linearise(s.X, s.weights);
  s.rows.update(s.weights, s.mass, s.h);
}

/// A number so large that start and end do not count.
constexpr int iterations = 20;

void iterate(StageInputs& s) {
  s.iteration.solve(s.B, s.Y, 1e-30, iterations);
}

void crouzeix_raviart_energy(StageInputs& s) {
  s.crouzeix_raviart->energy(s.X);
}

void crouzeix_raviart_gradient(StageInputs& s) {
  s.crouzeix_raviart->energy_and_gradient(s.X, s.G);
}

void lagrange_energy(StageInputs& s) {
  s.lagrange->energy(s.X);
}

void lagrange_gradient(StageInputs& s) {
  s.lagrange->energy_and_gradient(s.X, s.G);
}

void write(StageInputs& s) {
  s.written_bytes =
      static_cast<double>(write_mesh(s.file, s.moved, s.output, {.overwrite = true}).bytes);
}

double size_of(const auto& matrix) {
  return static_cast<double>(matrix.size()) * sizeof(*matrix.data());
}

double read_bytes(const StageInputs& s) {
  return static_cast<double>(s.file.bytes().size());
}

double written_bytes(const StageInputs& s) {
  return s.written_bytes;
}

/// The triangles, and the tables over vertices, edges and hinges made from them.
double topology_bytes(const StageInputs& s) {
  const Topology& t = s.topology;
  return 2 * size_of(t.F) + size_of(t.E) + size_of(t.edge_triangles.value) + size_of(t.H) +
         size_of(t.hinge_triangles) + size_of(t.stars.value);
}

double pattern_bytes(const StageInputs& s) {
  return size_of(s.crouzeix_raviart->stencils().value) + size_of(s.J.row);
}

double matrix_bytes(const StageInputs& s) {
  return size_of(s.X) + size_of(s.crouzeix_raviart->stencils().value) + size_of(s.J.value);
}

double analysis_bytes(const StageInputs& s) {
  return size_of(s.J.row);
}

double factor_flops(const StageInputs& s) {
  return s.analysis->forecast().flops;
}

/// The factor is read twice: forward and backward substitution.
double solve_bytes(const StageInputs& s) {
  return 2 * sizeof(double) * s.analysis->forecast().factor_entries;
}

double float_solve_bytes(const StageInputs& s) {
  return 2 * sizeof(float) * s.analysis->forecast().factor_entries;
}

double rows_bytes(const StageInputs& s) {
  return size_of(s.X) + size_of(s.crouzeix_raviart->stencils().value) +
         s.rows.entries() * (sizeof(float) + sizeof(Index));
}

/// The rows are read, and four vectors are read and written.
double iteration_bytes(const StageInputs& s) {
  return iterations * (s.rows.entries() * (sizeof(float) + sizeof(Index)) +
                       8.0 * sizeof(float) * 4.0 * s.rows.size());
}

double positions(const StageInputs& s) {
  return size_of(s.X);
}

double positions_and_gradient(const StageInputs& s) {
  return 2 * size_of(s.X);
}

bool is_analysed_quickly(const StageInputs& s) {
  return s.analysis_seconds < longest_stage;
}

/// Leaves the factor empty if the matrix is not positive definite in that precision.
void prepare_floats(StageInputs& s) {
  try {
    s.float_cholesky.emplace(*s.analysis, Precision::float32);
    s.float_cholesky->factor(s.J);
  } catch (const FactorizationFailed&) {
    s.float_cholesky.reset();
  }
}

bool has_factor(const StageInputs& s) {
  return s.cholesky.has_value();
}

bool has_float_factor(const StageInputs& s) {
  return s.float_cholesky.has_value();
}

/// Whether the factors of the inputs and that of the stage fit into memory.
bool worth_factoring(const FactorForecast& forecast) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return forecast.flops < longest_stage * slow_factorization &&
         (2 * sizeof(double) + sizeof(float)) * forecast.factor_entries < share_of_memory * memory;
}

constexpr std::array table{
    Stage{"read", read, read_bytes},
    Stage{"topology", build, topology_bytes},
    Stage{"bind", create, topology_bytes},
    Stage{"pattern", make_pattern, pattern_bytes},
    Stage{"assemble", assemble, matrix_bytes},
    Stage{"analyse", analyse, analysis_bytes, nullptr, is_analysed_quickly},
    Stage{"factor", factor, nullptr, factor_flops, has_factor},
    Stage{"factor float32", factor_in_floats, nullptr, factor_flops, has_float_factor},
    Stage{"solve", solve, solve_bytes, nullptr, has_factor},
    Stage{"solve float32", solve_in_floats, float_solve_bytes, nullptr, has_float_factor},
    Stage{"rows", assemble_rows, rows_bytes},
    Stage{"20 iterations", iterate, iteration_bytes},
    Stage{"gradient", crouzeix_raviart_gradient, positions_and_gradient},
    Stage{"energy", crouzeix_raviart_energy, positions},
    Stage{"lagrange gradient", lagrange_gradient, positions_and_gradient},
    Stage{"lagrange energy", lagrange_energy, positions},
    Stage{"write", write, written_bytes},
};

}  // namespace

StageInputs::StageInputs(std::string input_path, std::string output_path)
    : path(std::move(input_path)),
      output(std::move(output_path)),
      file(read_mesh(path)),
      X(file.mesh().X),
      moved(0.999 * X),
      topology(build_topology(X, triangulate(file.mesh()).F)),
      crouzeix_raviart(bending_model("crouzeix-raviart").create(topology, {})),
      lagrange(bending_model("lagrange").create(topology, {})),
      unknowns(std::vector<std::uint8_t>(topology.vertex_count, 0)),
      terms(crouzeix_raviart->stencils(), topology.vertex_count),
      assembler(terms, unknowns),
      J(assembler.pattern()),
      rows(terms, unknowns),
      iteration(rows),
      B(X) {
  assemble(*this);
  assemble_rows(*this);
  write(*this);
  {
    const Stopwatch watch(analysis_seconds);
    analysis.emplace(J, X);
  }
  if (worth_factoring(analysis->forecast())) {
    cholesky.emplace(*analysis, Precision::float64);
    cholesky->factor(J);
    prepare_floats(*this);
  }
}

std::span<const Stage> stages() {
  return table;
}

}  // namespace ibmfair::benchmarks
