// A mesh file that all ranks read and write together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "commands/host.h"
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

  /// Returns the mesh in blocks. May be called only once, because the mesh is moved out.
  virtual BlockMesh take_mesh() = 0;

  virtual bool has_texture_coordinates() const = 0;

  /// Like the members of MeshFile with these names, for the vertices of this rank's block only.
  /// Both throw Failure.
  virtual std::vector<std::uint8_t> vertex_mask(const std::string& name) = 0;
  virtual std::vector<double> vertex_values(const std::string& name) = 0;

  /// Writes the mesh with the vertices of the piece at X (#V of the piece x 3). Throws Failure; in
  /// this case the file at `path` is unchanged. The report is about the whole file, and complete
  /// only on the first rank.
  virtual WriteReport write(const MeshPiece& piece, const Points& X, const std::string& path,
                            const WriteOptions& options) = 0;
};

/// Opens the mesh. A binary PLY file of triangles is read and written by ranges of bytes, so that
/// no rank holds the whole file. Every other file is read and written by the first rank; if there
/// are several ranks, a note tells the user so. Throws Failure.
std::unique_ptr<MeshSource> open_source(const Communicator& comm, const std::string& input,
                                        const std::string& output,
                                        const commands::InputOptions& options,
                                        const commands::Host& host);

}  // namespace ibmfair::petsc
