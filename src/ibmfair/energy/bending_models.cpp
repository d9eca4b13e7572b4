#include <array>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/crouzeix_raviart.h"
#include "ibmfair/energy/lagrange.h"

namespace ibmfair {
namespace {

template <class Member>
std::unique_ptr<BendingEnergy> bind(const Topology& topology, const EnergyOptions& options) {
  return std::make_unique<Member>(topology, options);
}

constexpr std::array<BendingModel, 2> models{{
    {"crouzeix-raviart", "edge-based; unfolds spikes, for denoising", bind<CrouzeixRaviart>},
    {"lagrange", "vertex-based cotangent Laplacian; consistent, for stationary limits",
     bind<Lagrange>},
}};

}  // namespace

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
