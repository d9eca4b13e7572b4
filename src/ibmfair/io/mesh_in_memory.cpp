#include "ibmfair/io/mesh_in_memory.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

/// Appends numbers to bytes that are large enough.
class Writer {
 public:
  explicit Writer(char* place) : place_(place) {}

  template <class T>
  void put(const T* values, std::size_t count) {
    std::memcpy(place_, values, count * sizeof(T));
    place_ += count * sizeof(T);
  }

 private:
  char* place_;
};

std::string header(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list int int vertex_indices\nend_header\n",
      std::endian::native == std::endian::little ? "little" : "big", vertices, faces);
}

void put_faces(const MeshView& mesh, Writer& out) {
  for (std::size_t f = 0; f + 1 < mesh.first.size(); ++f) {
    const auto count = static_cast<std::int32_t>(mesh.first[f + 1] - mesh.first[f]);
    out.put(&count, 1);
    out.put(mesh.corner.data() + mesh.first[f], static_cast<std::size_t>(count));
  }
}

}  // namespace

MeshFile mesh_in_memory(const std::string& name, const MeshView& mesh) {
  const std::size_t vertices = mesh.X.size() / 3, faces = mesh.first.size() - 1;
  const std::string text = header(vertices, faces);
  const std::size_t size = text.size() + mesh.X.size() * sizeof(double) +
                           (faces + mesh.corner.size()) * sizeof(std::int32_t);
  auto bytes = SourceBytes::from_memory(name, size, [&](char* place) {
    Writer out(place);
    out.put(text.data(), text.size());
    out.put(mesh.X.data(), mesh.X.size());
    put_faces(mesh, out);
  });
  return read_mesh(std::move(bytes), {.format = "ply"});
}

}  // namespace ibmfair
