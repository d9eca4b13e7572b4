#include "ibmfair/io/mesh_in_memory.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

/// Appends numbers to bytes that were made large enough before.
class Writer {
 public:
  explicit Writer(char* place) : place_(place) {}

  template <class T>
  void put(T value) {
    std::memcpy(place_, &value, sizeof(T));
    place_ += sizeof(T);
  }

 private:
  char* place_;
};

std::string header(const Mesh& mesh, std::span<const VertexProperty> properties) {
  std::string text = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      std::endian::native == std::endian::little ? "little" : "big", mesh.X.rows());
  for (const VertexProperty& property : properties) {
    text += fmt::format("property double {}\n", property.name);
  }
  return text + fmt::format("element face {}\nproperty list int int vertex_indices\nend_header\n",
                            mesh.faces.size());
}

}  // namespace

MeshFile mesh_in_memory(const std::string& name, const Mesh& mesh,
                        std::span<const VertexProperty> properties) {
  std::string bytes = header(mesh, properties);
  const std::size_t begin = bytes.size();
  bytes.resize(begin +
               static_cast<std::size_t>(mesh.X.rows()) * (3 + properties.size()) * sizeof(double) +
               (static_cast<std::size_t>(mesh.faces.size()) + mesh.faces.corner.size()) *
                   sizeof(std::int32_t));
  Writer out(bytes.data() + begin);
  for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
    for (int i = 0; i < 3; ++i) {
      out.put(mesh.X(v, i));
    }
    for (const VertexProperty& property : properties) {
      out.put(property.values[static_cast<std::size_t>(v)]);
    }
  }
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const std::span<const Index> corners = mesh.faces[f];
    out.put(static_cast<std::int32_t>(corners.size()));
    for (const Index corner : corners) {
      out.put(static_cast<std::int32_t>(corner));
    }
  }
  return read_mesh(SourceBytes::from_memory(name, bytes), {.format = "ply"});
}

}  // namespace ibmfair
