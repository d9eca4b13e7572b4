// What the cracks of a mesh are, and which option leaves no hole.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "ibmfair/fill/holes.h"
#include "ibmfair/fill/stitch.h"

namespace ibmfair::commands {

/// The cracks of a mesh, with the results of welding and of stitching, which are computed on a copy
/// of the mesh.
struct CrackSummary {
  Index loops = 0;           ///< boundary loops
  Index cracks = 0;          ///< loops that are cracks
  Index partial_cracks = 0;  ///< loops of which a part is a crack
  Index slits = 0;
  Index t_junctions = 0;
  std::int64_t coincident = 0;             ///< vertices that lie exactly on others
  std::optional<OpenParts> welded;         ///< with --weld
  double tolerance = 0;                    ///< of --weld LENGTH, length
  std::optional<OpenParts> welded_within;  ///< with --weld LENGTH; only if vertices nearly coincide
  std::optional<OpenParts> stitched;       ///< with --stitch
  double reach = 0;                        ///< of --stitch LENGTH, the largest width of a slit
  std::optional<OpenParts> stitched_within;  ///< with --stitch LENGTH; only if there are slits
};

/// `holes`: those of the mesh, whose topology is `topology`. Nothing is computed that costs time if
/// no loop is a crack or touches itself.
CrackSummary summarise_cracks(const Mesh& mesh, const Topology& topology,
                              const std::vector<Hole>& holes);

/// Sentences about the cracks and about the options that close them.
std::vector<std::string> crack_notes(const CrackSummary& summary);

nlohmann::ordered_json crack_json(const CrackSummary& summary);

/// What is open after welding or stitching.
nlohmann::ordered_json open_json(const OpenParts& parts);

}  // namespace ibmfair::commands
