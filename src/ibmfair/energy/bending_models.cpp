#include <array>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/crouzeix_raviart.h"
#include "ibmfair/energy/lagrange.h"

namespace ibmfair {
namespace {

template <class Member>
std::unique_ptr<BendingEnergy> make(const Topology& topology, const EnergyOptions& options) {
  return std::make_unique<Member>(topology, options);
}

constexpr std::array<BendingModel, 2> models{{
    {.name = "crouzeix-raviart",
     .summary = "edge-based; unfolds spikes, for denoising",
     .make = make<CrouzeixRaviart>,
     .keeps_sharp = true},
    {.name = "lagrange",
     .summary = "vertex-based cotangent Laplacian; consistent, for stationary limits",
     .make = make<Lagrange>,
     .takes_spontaneous_curvature = true},
}};

/// The names of the members that have a property, for messages.
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
    throw BadOption(fmt::format("the Laplacian {} cannot keep sharp hinges; these can: {}",
                                model.name, names_with(&BendingModel::keeps_sharp)));
  }
  if (options.sharp_angle > 0 && !options.mass) {
    throw BadOption("hinges are kept sharp with the mass matrix only");
  }
  if (options.spontaneous_curvature.size() > 0 && !model.takes_spontaneous_curvature) {
    throw BadOption(fmt::format("the Laplacian {} takes no spontaneous curvature; these do: {}",
                                model.name,
                                names_with(&BendingModel::takes_spontaneous_curvature)));
  }
}

}  // namespace

std::unique_ptr<BendingEnergy> BendingModel::bind(const Topology& topology,
                                                  const EnergyOptions& options) const {
  require_known(*this, options);
  if (options.spontaneous_curvature.size() > 0 && !topology.orientable) {
    throw BadMesh("a spontaneous curvature needs a mesh with two sides");
  }
  return make(topology, options);
}

std::span<const BendingModel> bending_models() {
  return models;
}

const BendingModel& bending_model(std::string_view name) {
  std::string known;
  for (const BendingModel& model : models) {
    if (model.name == name) {
      return model;
    }
    known += known.empty() ? "" : ", ";
    known += model.name;
  }
  throw BadOption(fmt::format("unknown Laplacian '{}'; there are: {}", name, known));
}

double bending_energy(const Points& X, const Topology& topology, std::string_view model) {
  return bending_model(model).bind(topology, {})->energy(X);
}

}  // namespace ibmfair
