// A mesh file that the first rank reads and writes on behalf of all ranks.
#pragma once

#include "petsc_engine/mesh_source.h"

namespace ibmfair::petsc {

class WholeSource final : public MeshSource {
 public:
  /// Throws Failure. Collective.
  WholeSource(const Communicator& comm, const std::string& path,
              const commands::InputOptions& options, const commands::Host& host);

  BlockMesh take_mesh() override { return std::move(mesh_); }
  bool has_texture_coordinates() const override { return has_texture_; }
  std::vector<std::uint8_t> vertex_mask(const std::string& name) override;
  std::vector<double> vertex_values(const std::string& name) override;
  WriteReport write(const MeshPiece& piece, const Points& X, const std::string& path,
                    const WriteOptions& options) override;

 private:
  const Communicator& comm_;
  MeshFile file_;  // on the first rank only
  BlockMesh mesh_;
  Blocks vertices_;
  bool has_texture_ = false;
};

}  // namespace ibmfair::petsc
