// For any mesh and options, the flow ends with finite positions and with the fixed vertices in
// their places, and the guarded flow ends with no more energy than at its start; or the flow says
// why it failed and leaves the mesh as it was. A second run gives the same bits.
#include <algorithm>
#include <cmath>
#include <optional>

#include "fuzz/small_mesh.h"
#include "fuzz/targets.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/material_directions.h"
#include "ibmfair/flow/fixed_vertices.h"
#include "ibmfair/flow/time_scale.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::fuzz {

namespace {

struct FlowCase {
  BoundaryCondition boundary = BoundaryCondition::fixed;
  FlowOptions options;
  double cutoff_edges = 8;

  explicit FlowCase(Bytes& bytes) {
    constexpr std::array models{"crouzeix-raviart", "lagrange",           "weighted", "weighted",
                                "umbrella",         "intrinsic-delaunay", "lagrange", "lagrange"};
    constexpr std::array masses{"", "", "", "galerkin", "", "", "galerkin", "voronoi"};
    constexpr std::array solvers{"auto", "multifrontal", "cg"};
    constexpr std::array cutoffs{8.0, 1.0, 40.0, 1e-3, 1e4, 3.0};
    const std::uint8_t kinds = bytes.next();
    const int member = (kinds & 1) | kinds >> 6 << 1;
    options.laplacian = models[member];
    options.mass_matrix = masses[member];
    options.mass = (kinds & 2) == 0;
    options.metric = (kinds & 4) == 0 ? Metric::mass : Metric::identity;
    options.guarded = (kinds & 8) == 0;
    options.relax = (kinds & 16) == 0;
    const bool short_moves = (kinds & 32) != 0;
    const std::uint8_t solver = bytes.next();
    options.solver = solvers[solver % solvers.size()];
    further_ = static_cast<std::uint8_t>(solver / solvers.size());
    boundary = static_cast<BoundaryCondition>(bytes.below(3));
    options.steps = 1 + bytes.below(4);
    options.newton_iterations = 1 + bytes.below(3);
    cutoff_edges = cutoffs[bytes.below(cutoffs.size())];
    if (short_moves) options.max_move = 0.01;
    // Twicing takes no byte of its own, so that old seeds keep their meaning.
    options.twicing = std::max(0, options.steps - 2);
    options.keep_volume = asks_for(1);
    options.keep_area = asks_for(2);
    options.sharp_angle = asks_for(4) ? 0.4 : 0;
  }

  /// Sets the options that have a value for each vertex or triangle.
  void fit_to(const Mesh& mesh, const Topology& topology) {
    if (asks_for(8)) {
      const auto values = Eigen::VectorXd::LinSpaced(mesh.X.rows(), 0.2, 3);
      options.cutoff_factor = values;
    }
    if (asks_for(16)) {
      const double size = mean_edge_length(mesh.X, topology.E);
      options.spontaneous_curvature = Eigen::VectorXd::Constant(mesh.X.rows(), 0.5 / size);
    }
    if (asks_for(32)) {
      options.material_directions = material_directions(mesh.X, topology, {1, 0.5, 0}, 4);
    }
  }

 private:
  /// These options take no bytes of their own, either.
  bool asks_for(std::uint8_t kind) const { return (further_ & kind) != 0; }

  std::uint8_t further_ = 0;
};

/// The result of a flow, or the reason why it did not begin.
struct Ending {
  Points X;
  FlowReport report;
  std::string refusal;
};

Ending run(const Mesh& mesh, const Topology& topology, const std::vector<std::uint8_t>& fixed,
           const FlowOptions& options) {
  Ending ending{mesh.X, {}, {}};
  try {
    ending.report = willmore_flow(ending.X, topology, fixed, options);
  } catch (const Error& error) {
    ending.refusal = error.what();
    law(!ending.refusal.empty(), "a refusal says why");
    law(ending.X == mesh.X, "a flow that is refused moves nothing");
  }
  return ending;
}

double energy_of(const Points& X, const Topology& topology, const std::vector<std::uint8_t>& fixed,
                 const FlowOptions& options) {
  EnergyOptions energy = options.energy_options();
  energy.active = fixed;
  for (std::uint8_t& flag : energy.active) {
    flag = flag != 0 ? 0 : 1;
  }
  return bending_model(options.laplacian).create(topology, energy)->energy(X);
}

/// If the volume or the area is to be kept, it must be unchanged up to the rounding of the
/// coordinates.
void require_kept(const Points& from, const Points& to, const Topology& topology,
                  const FlowOptions& options) {
  constexpr double rounding = 1e-9;
  const double reach = from.cwiseAbs().maxCoeff() + to.cwiseAbs().maxCoeff();
  const double edges = static_cast<double>(topology.E.rows()) *
                       (mean_edge_length(from, topology.E) + mean_edge_length(to, topology.E));
  const double volume = enclosed_volume(from, topology.F), area = surface_area(from, topology.F);
  if (options.keep_volume && std::isfinite(volume)) {
    law(std::abs(enclosed_volume(to, topology.F) - volume) <=
            rounding * (std::abs(volume) + reach * edges * edges),
        "the volume is kept");
  }
  if (options.keep_area && std::isfinite(area)) {
    law(std::abs(surface_area(to, topology.F) - area) <= rounding * (area + reach * edges),
        "the area is kept");
  }
}

}  // namespace

void flow(std::string_view input) {
  Bytes bytes(input);
  FlowCase wanted(bytes);
  const Mesh mesh = small_mesh(bytes);
  if (mesh.faces.size() == 0) return;  // no reader returns such a mesh
  const Topology topology = build_topology(mesh.X, triangulate(mesh).F);
  const std::vector<std::uint8_t> fixed = fixed_vertices(topology, wanted.boundary);
  wanted.fit_to(mesh, topology);
  FlowOptions& options = wanted.options;
  const double cutoff = wanted.cutoff_edges * mean_edge_length(mesh.X, topology.E);
  options.total_time = time_in_flow_units(time_for_cutoff(cutoff), mesh.X, topology, options);

  const Ending once = run(mesh, topology, fixed, options);
  law(once.X.rows() == mesh.X.rows() && once.X.allFinite(), "all ends in finite places");
  for (Index v = 0; v < topology.vertex_count; ++v)
    law(fixed[v] == 0 || once.X.row(v) == mesh.X.row(v), "fixed vertices stay where they are");
  if (once.refusal.empty()) require_kept(mesh.X, once.X, topology, options);
  if (once.refusal.empty() && options.guarded) {
    const FlowReport& report = once.report;
    law(report.energy_after <= report.energy_before, "the report's energy does not rise");
    if (report.unknowns > 0) {
      const double before = energy_of(mesh.X, topology, fixed, options);
      const double after = energy_of(once.X, topology, fixed, options);
      law(after <= before, "the energy does not rise");
    }
  }
  const Ending twice = run(mesh, topology, fixed, options);
  law(twice.X == once.X && twice.refusal == once.refusal, "the same comes out again");
}

}  // namespace ibmfair::fuzz
