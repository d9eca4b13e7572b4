#include "ibmfair/io/generate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ibmfair {

bool texture_is_per_vertex(const Mesh& mesh, const MeshAttributes& attributes) {
  const std::vector<Index>& corner = mesh.faces.corner;
  std::vector<Index> first(static_cast<std::size_t>(mesh.X.rows()), -1);
  const auto coordinate = [&](Index t) { return attributes.texture_coordinates[t]; };
  for (std::size_t i = 0; i < attributes.corner_texture.size(); ++i) {
    const Index t = attributes.corner_texture[i];
    Index& known = first[corner[i]];
    if (t < 0 || t == known) continue;
    if (known >= 0 && coordinate(t) != coordinate(known)) return false;
    known = t;
  }
  return true;
}

std::vector<std::array<double, 2>> texture_per_vertex(const Mesh& mesh,
                                                      const MeshAttributes& attributes) {
  std::vector<std::array<double, 2>> texture(static_cast<std::size_t>(mesh.X.rows()), {0.0, 0.0});
  for (std::size_t i = 0; i < attributes.corner_texture.size(); ++i) {
    const Index t = attributes.corner_texture[i];
    if (t < 0) continue;
    texture[mesh.faces.corner[i]] = attributes.texture_coordinates[t];
  }
  return texture;
}

int byte_colour(double value) {
  if (!(value > 0.0)) return 0;  // for NaN, too
  return static_cast<int>(std::lround(255.0 * std::min(value, 1.0)));
}

std::vector<std::string> note_left_out(std::string_view format, std::vector<std::string> what) {
  if (what.empty()) return {};
  constexpr std::size_t most = 8;
  if (what.size() > most) {
    const std::size_t more = what.size() - most;
    what.resize(most);
    what.push_back(fmt::format("and {} more", more));
  }
  return {fmt::format("left out of the {} file: {}", format, fmt::join(what, ", "))};
}

}  // namespace ibmfair
