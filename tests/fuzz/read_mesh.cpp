// Any bytes that are read as OBJ, PLY or OFF give a sound mesh or a clear message. tools/fuzz
// limits time and memory: nothing is allocated for a size that the file only claims.
#include <optional>

#include "fuzz/mesh_laws.h"
#include "fuzz/targets.h"
#include "support/mesh_io.h"

namespace ibmfair::fuzz {

namespace {

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

}  // namespace ibmfair::fuzz
