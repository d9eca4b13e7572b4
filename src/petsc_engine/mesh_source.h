// A mesh file as all ranks together read and write it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "commands/shared_options.h"
#include "ibmfair/io/mesh_file.h"
#include "petsc_engine/mesh_piece.h"

namespace ibmfair::petsc {

/// All members are collective.
class MeshSource {
 public:
  MeshSource() = default;
  MeshSource(const MeshSource&) = delete;
  MeshSource& operator=(const MeshSource&) = delete;
  virtual ~MeshSource() = default;

  /// The mesh, in blocks; once.
  virtual BlockMesh take_mesh() = 0;

  virtual bool has_texture_coordinates() const = 0;

  /// For this rank's block of vertices, what MeshFile has for all. Both throw Failure.
  virtual std::vector<std::uint8_t> vertex_mask(const std::string& name) = 0;
  virtual std::vector<double> vertex_values(const std::string& name) = 0;

  /// Writes the mesh with its vertices at X (#V of the piece x 3). Throws Failure, with what was at
  /// `path` as it was before. The report is that of the whole file, and complete on the first rank.
  virtual WriteReport write(const MeshPiece& piece, const Points& X, const std::string& path,
                            const WriteOptions& options) = 0;
};

/// Opens the mesh: a binary PLY file of triangles by ranges of its bytes, so that no rank has all
/// of it; every other one is read and written by the first rank, and the user is told so. Throws
/// Failure.
std::unique_ptr<MeshSource> open_source(const Communicator& comm, const std::string& input,
                                        const std::string& output,
                                        const commands::InputOptions& options,
                                        const commands::Console& console);

}  // namespace ibmfair::petsc
