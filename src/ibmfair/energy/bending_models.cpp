#include <array>
#include <iterator>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/named_row.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/crouzeix_raviart.h"
#include "ibmfair/energy/lagrange.h"
#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/energy/mass_matrices.h"
#include "ibmfair/energy/vertex_energy.h"
#include "ibmfair/energy/vertex_laplacians.h"

namespace ibmfair {
namespace {

using Bound = std::unique_ptr<BendingEnergy>;

/// The two members with kernels of their own support one mass matrix, or none.
template <class Member>
Bound fast_member(const Topology& topology, EnergyOptions options, const MassMatrix& mass) {
  options.mass = mass.kind != MassMatrix::Kind::identity;
  return std::make_unique<Member>(topology, options);
}

Bound crouzeix_raviart(const Topology& topology, const EnergyOptions& options) {
  const MassMatrix& mass = mass_matrix(bending_model("crouzeix-raviart"), options);
  if (options.sharp_angle > 0 && mass.kind == MassMatrix::Kind::identity) {
    throw BadOption("--keep-sharp needs the mass matrix; leave out --no-mass and --mass none");
  }
  return fast_member<CrouzeixRaviart>(topology, options, mass);
}

LaplacianMatrices crouzeix_raviart_matrices(const Points& X, const Topology& topology,
                                            const EnergyOptions& options) {
  return edge_matrices(X, topology, mass_matrix(bending_model("crouzeix-raviart"), options));
}

Bound lagrange(const Topology& topology, const EnergyOptions& options) {
  const MassMatrix& mass = mass_matrix(bending_model("lagrange"), options);
  if (options.spontaneous_curvature.size() > 0 && !options.material_directions.empty()) {
    throw BadOption("--h0 and --anisotropy cannot be combined");
  }
  if (!options.material_directions.empty()) {
    return std::make_unique<VertexEnergy>(topology, options, directional_laplacian, mass);
  }
  if (mass.name == "barycentric" || mass.kind == MassMatrix::Kind::identity) {
    return fast_member<Lagrange>(topology, options, mass);
  }
  if (options.spontaneous_curvature.size() > 0) {
    throw BadOption(fmt::format("--h0 needs --mass barycentric, not {}", mass.name));
  }
  return std::make_unique<VertexEnergy>(topology, options, cotangent_laplacian, mass);
}

/// The functions of a vertex-based Laplacian's row in the table.
template <const VertexLaplacian& laplacian, const std::string_view& name>
struct VertexModel {
  static Bound make(const Topology& topology, const EnergyOptions& options) {
    return std::make_unique<VertexEnergy>(topology, options, laplacian,
                                          mass_matrix(bending_model(name), options));
  }

  static LaplacianMatrices matrices(const Points& X, const Topology& topology,
                                    const EnergyOptions& options) {
    return vertex_matrices(X, topology, options, laplacian,
                           mass_matrix(bending_model(name), options));
  }
};

constexpr std::string_view lagrange_name = "lagrange", weighted_name = "weighted",
                           delaunay_name = "intrinsic-delaunay", umbrella_name = "umbrella";
using CotangentModel = VertexModel<cotangent_laplacian, lagrange_name>;
using WeightedModel = VertexModel<weighted_laplacian, weighted_name>;
using DelaunayModel = VertexModel<intrinsic_delaunay_laplacian, delaunay_name>;
using UmbrellaModel = VertexModel<umbrella_laplacian, umbrella_name>;

constexpr std::array<std::string_view, 2> edge_masses{"crouzeix-raviart", "none"};
constexpr std::array<std::string_view, 4> vertex_masses{"barycentric", "voronoi", "galerkin",
                                                        "none"};
constexpr std::array<std::string_view, 2> delaunay_masses{"voronoi", "none"};
constexpr std::array<std::string_view, 3> umbrella_masses{"valence", "barycentric", "none"};

constexpr BendingModel models[]{
    {.name = "crouzeix-raviart",
     .summary = "edge-based; unfolds folded triangles; the default of smooth",
     .make = crouzeix_raviart,
     .matrices = crouzeix_raviart_matrices,
     .masses = edge_masses,
     .keeps_sharp = true,
     .knows_parts = true},
    {.name = lagrange_name,
     .summary = "vertex-based cotangent Laplacian; consistent, for stationary limits",
     .make = lagrange,
     .matrices = CotangentModel::matrices,
     .masses = vertex_masses,
     .takes_material_directions = true,
     .takes_spontaneous_curvature = true,
     .knows_parts = true},
    {.name = weighted_name,
     .summary = "dual edges between power centres of circles about the vertices",
     .make = WeightedModel::make,
     .matrices = WeightedModel::matrices,
     .masses = vertex_masses},
    {.name = delaunay_name,
     .summary = "cotangent weights of the intrinsic Delaunay triangulation, never negative",
     .make = DelaunayModel::make,
     .matrices = DelaunayModel::matrices,
     .masses = delaunay_masses},
    {.name = umbrella_name,
     .summary = "graph Laplacian; makes edges even; for noise on uneven triangles",
     .make = UmbrellaModel::make,
     .matrices = UmbrellaModel::matrices,
     .masses = umbrella_masses,
     .evens_edges = true,
     .knows_parts = true},
};

/// The names of the members that have a property, for error messages.
std::string names_with(bool BendingModel::*property) {
  std::string names;
  for (const BendingModel& model : models) {
    if (model.*property) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", model.name);
    }
  }
  return names;
}

void require_known(const BendingModel& model, const EnergyOptions& options) {
  if (options.sharp_angle > 0 && !model.keeps_sharp) {
    throw BadOption(
        fmt::format("the Laplacian {} cannot be combined with --keep-sharp; choose another by "
                    "--laplacian: {}",
                    model.name, names_with(&BendingModel::keeps_sharp)));
  }
  if (!options.material_directions.empty() && !model.takes_material_directions) {
    throw BadOption(
        fmt::format("the Laplacian {} cannot be combined with --anisotropy; choose another "
                    "by --laplacian: {}",
                    model.name, names_with(&BendingModel::takes_material_directions)));
  }
  if (options.spontaneous_curvature.size() > 0 && !model.takes_spontaneous_curvature) {
    throw BadOption(
        fmt::format("the Laplacian {} cannot be combined with --h0; choose another by "
                    "--laplacian: {}",
                    model.name, names_with(&BendingModel::takes_spontaneous_curvature)));
  }
  if (!options.own_vertices.empty() && !model.knows_parts) {
    throw BadOption(
        fmt::format("the Laplacian {} needs the whole mesh in one process, so it cannot be "
                    "combined with --engine petsc; choose another by --laplacian: {}",
                    model.name, names_with(&BendingModel::knows_parts)));
  }
  if (!options.own_vertices.empty() &&
      mass_matrix(model, options).kind == MassMatrix::Kind::consistent) {
    throw BadOption(
        fmt::format("--mass {} needs the whole mesh in one process, so it cannot be combined "
                    "with --engine petsc",
                    mass_matrix(model, options).name));
  }
}

void require_one_for_each(std::ptrdiff_t given, std::ptrdiff_t wanted, const char* what,
                          const char* elements) {
  if (given > 0 && given != wanted) {
    throw BadOption(fmt::format("there must be a {} for each of the {} {}, not {}", what, wanted,
                                elements, given));
  }
}

}  // namespace

std::unique_ptr<BendingEnergy> BendingModel::create(const Topology& topology,
                                                    const EnergyOptions& options) const {
  require_known(*this, options);
  require_one_for_each(options.spontaneous_curvature.size(), topology.vertex_count,
                       "spontaneous curvature", "vertices");
  require_one_for_each(std::ssize(options.material_directions), topology.F.rows(),
                       "material direction", "triangles");
  if (options.spontaneous_curvature.size() > 0 && !topology.orientable) {
    throw BadMesh("--h0 needs an orientable mesh, and this one has only one side");
  }
  return make(topology, options);
}

std::span<const BendingModel> bending_models() {
  return models;
}

const BendingModel& bending_model(std::string_view name) {
  return row_named(bending_models(), "Laplacian", name);
}

double bending_energy(const Points& X, const Topology& topology, std::string_view model) {
  return bending_model(model).create(topology, {})->energy(X);
}

}  // namespace ibmfair
