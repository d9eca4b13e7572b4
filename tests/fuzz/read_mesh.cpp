// Any bytes that are read as OBJ, PLY, OFF or 3MF give a sound mesh or a clear message. tools/fuzz
// limits time and memory: nothing is allocated for a size that the file only claims.
#include <optional>

#include "fuzz/mesh_laws.h"
#include "fuzz/targets.h"
#include "ibmfair/io/face_edits.h"
#include "support/mesh_io.h"
#include "support/zip_files.h"

namespace ibmfair::fuzz {

namespace {

/// A face can be replaced whatever the file holds: here by two copies of itself whose corners begin
/// with the second.
void require_editable(const MeshFile& file) {
  const auto corners = static_cast<Index>(file.mesh().faces[0].size());
  std::vector<EditedCorner> piece;
  for (Index i = 0; i < corners; ++i) {
    const Index corner = (i + 1) % corners;
    piece.push_back({file.mesh().faces[0][corner], corner, corner, 0});
  }
  const std::vector<FaceEdit> edits{{0, {piece, piece}}};
  const Mesh wanted = with_edited_faces(file.mesh(), edits),
             edited = edit_faces(file, edits).file.mesh();
  law(edited.X == wanted.X, "editing a face moves no vertex");
  law(edited.faces.first == wanted.faces.first && edited.faces.corner == wanted.faces.corner,
      "editing a face replaces this face alone");
}

void read_as(std::string_view bytes, const std::string& format) {
  const std::string name = "mesh." + format;
  std::optional<MeshFile> file;
  try {
    file = test::MeshFiles::read(bytes, name);
  } catch (const BadFile& error) {
    require_clear(error, name, bytes);
    return;
  }
  require_sound(*file);
  require_editable(*file);
  const MeshFile welded = test::MeshFiles::read(bytes, name, {.format = format, .weld = true});
  require_sound(welded);
  law(welded.mesh().faces.first == file->mesh().faces.first, "welding keeps every face");
  law(welded.welded() == (welded.mesh().X.rows() < file->mesh().X.rows()),
      "welding leaves fewer vertices, or does nothing");
}

}  // namespace

void read_obj(std::string_view bytes) {
  read_as(bytes, "obj");
}

void read_ply(std::string_view bytes) {
  read_as(bytes, "ply");
}

void read_off(std::string_view bytes) {
  read_as(bytes, "off");
}

void read_3mf(std::string_view bytes) {
  // As an archive, few bytes come past its checksums; so they are also the model in one.
  const std::string name = "mesh.3mf";
  for (const std::string& archive :
       {std::string(bytes), test::zip_of({{"3D/3dmodel.model", std::string(bytes)}}, false)}) {
    try {
      require_sound(test::MeshFiles::read(archive, name));
    } catch (const BadFile& error) {
      require_clear(error, name, archive);
    }
  }
}

}  // namespace ibmfair::fuzz
