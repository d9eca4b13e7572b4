#include "commands/mesh_statistics.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "ibmfair/base/angle.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/flow/steps/folds.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair::commands {

MeshStatistics mesh_statistics(const Points& X, const Topology& topology,
                               const FlowOptions& options) {
  return mesh_statistics(
      X, topology,
      bending_model(options.laplacian).create(topology, options.energy_options())->energy(X));
}

MeshStatistics mesh_statistics(const Points& X, const Topology& topology, double energy) {
  MeshStatistics statistics;
  statistics.energy = energy;
  statistics.area = surface_area(X, topology.F);
  statistics.volume = topology.orientable ? enclosed_volume(X, topology.F)
                                          : std::numeric_limits<double>::quiet_NaN();
  statistics.smallest_angle = degrees(smallest_angle(X, topology.F));
  const std::vector<std::uint8_t> folded = folded_hinges(X, topology);
  statistics.folds = std::count(folded.begin(), folded.end(), 1);
  return statistics;
}

nlohmann::ordered_json mesh_statistics_json(const MeshStatistics& statistics) {
  return {{"energy", statistics.energy},
          {"area", statistics.area},
          {"volume", statistics.volume},
          {"smallest_angle_degrees", statistics.smallest_angle},
          {"folded_hinges", statistics.folds}};
}

nlohmann::ordered_json mesh_state_json(const Points& X, const Topology& topology,
                                       const FlowOptions& options) {
  nlohmann::ordered_json json = mesh_statistics_json(mesh_statistics(X, topology, options));
  json["vertices"] = topology.vertex_count;
  json["triangles"] = topology.F.rows();
  json["boundary_loops"] = topology.boundary_loops.size();
  return json;
}

}  // namespace ibmfair::commands
