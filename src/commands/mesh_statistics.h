// What commands measure of a mesh before and after they change it.
#pragma once

#include <cstdint>

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/base/types.h"
#include "ibmfair/flow/flow_options.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// What is measured of one state of a mesh.
struct MeshStatistics {
  double energy = 0;  ///< E_b of the whole mesh under the run's Laplacian
  double area = 0;
  double volume = 0;          ///< NaN if the mesh is not orientable
  double smallest_angle = 0;  ///< degrees
  std::int64_t folds = 0;     ///< hinges sharper than fold_angle
};

/// E_b, area, volume and quality of `X`.
MeshStatistics mesh_statistics(const Points& X, const Topology& topology,
                               const FlowOptions& options);

/// Like above, if E_b is already known: to create the energy of a mesh takes longer than everything
/// else.
MeshStatistics mesh_statistics(const Points& X, const Topology& topology, double energy);

/// The statistics as a JSON object.
nlohmann::ordered_json mesh_statistics_json(const MeshStatistics& statistics);

/// The statistics of `X` as a JSON object, with the numbers of vertices, triangles and boundary
/// loops, for runs that change the connectivity.
nlohmann::ordered_json mesh_state_json(const Points& X, const Topology& topology,
                                       const FlowOptions& options);

}  // namespace ibmfair::commands
