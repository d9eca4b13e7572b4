// Whether float32 is precise enough for the vertices that a run has moved or added.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Sums over the vertices and edges of a mesh. The sums of the pieces of a mesh add up to those of
/// the mesh.
struct RoundingSums {
  double rounding = 0;       ///< squared distances of `written` vertices to float32, length^2
  double moves = 0;          ///< squared moves, length^2
  double lengths = 0;        ///< of the edges, each counted once for every face, length
  std::int64_t written = 0;  ///< vertices that were moved or added
  std::int64_t moved = 0;    ///< vertices that were moved
  std::int64_t edges = 0;    ///< terms of `lengths`

  RoundingSums() = default;

  /// The sums over the first `own` vertices, which move from mesh.X to X (both #V x 3), and the
  /// edges that start at them in a face.
  RoundingSums(const Mesh& mesh, const Points& X, Index own);

  /// Adds new vertices.
  void add(const Points& added);

  /// Root mean squares, in mean edge lengths.
  double rms_rounding() const;
  double rms_move() const;
};

/// Whether rounding to float32 costs nothing that matters: the RMS rounding is less than a
/// thousandth of the mean edge length, so that face normals turn by less than about 0.1 degrees,
/// and less than a hundredth of the RMS move. `tools/precision_table` prints both for real meshes.
bool float32_suffices(const RoundingSums& sums);

/// The reason why it does not, without a full stop: "float32 rounds ...".
std::string why_float32_fails(const RoundingSums& sums);

/// Throws BadMesh if a coordinate is beyond the range of float32. `number_of` gives the number of
/// the vertex in a row of X for the message, and `holder` names the file that holds float32.
void require_float32_range(const Points& X, std::string_view holder,
                           const std::function<Index(Index)>& number_of = std::identity());

}  // namespace ibmfair
