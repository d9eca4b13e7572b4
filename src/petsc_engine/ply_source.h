// A binary PLY file of triangles, of which each rank reads and writes a range of bytes.
#pragma once

#include "petsc_engine/mesh_source.h"
#include "petsc_engine/mpi_file.h"
#include "petsc_engine/ply_rows.h"

namespace ibmfair::petsc {

class PlySource final : public MeshSource {
 public:
  /// Returns null if the file is not a binary PLY file of triangles, or if it is malformed.
  /// Collective.
  static std::unique_ptr<PlySource> open(const Communicator& comm, const std::string& path);

  BlockMesh take_mesh() override { return std::move(mesh_); }
  bool has_texture_coordinates() const override { return rows_.has_texture_coordinates(); }
  std::vector<std::uint8_t> vertex_mask(const std::string& name) override;
  std::vector<double> vertex_values(const std::string& name) override;
  WriteReport write(const MeshPiece& piece, const Points& X, const std::string& path,
                    const WriteOptions& options) override;

 private:
  PlySource(const Communicator& comm, const std::string& path, PlyRows rows);
  bool read();
  std::string rows_of_block(std::int64_t offset, std::int64_t row, const Blocks& blocks);
  void write_moved(MpiFile& out, const MeshPiece& piece, const Points& X,
                   const PlyRows::Rewriting& rewriting, const RowTypes& types);
  /// The types of the coordinates, from the moves on all ranks. Collective.
  RowTypes types_of(const MeshPiece& piece, const Points& X, const WriteOptions& options) const;

  const Communicator& comm_;
  std::string path_;
  PlyRows rows_;
  std::unique_ptr<MpiFile> file_;
  Blocks vertices_;
  BlockMesh mesh_;
};

}  // namespace ibmfair::petsc
