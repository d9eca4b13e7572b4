#include "ibmfair/io/make_room.h"

#include "ibmfair/base/huge_pages.h"

namespace ibmfair {

void make_room(Mesh& mesh, std::int64_t vertices, std::int64_t faces, std::int64_t corners) {
  mesh.X.resize(vertices, 3);
  std::vector<std::int64_t>& first = mesh.faces.first;
  std::vector<Index>& corner = mesh.faces.corner;
  first.reserve(static_cast<std::size_t>(faces) + 1);
  corner.reserve(static_cast<std::size_t>(corners));
  advise_huge_pages(mesh.X.data(), static_cast<std::size_t>(mesh.X.size()) * sizeof(double));
  advise_huge_pages(first.data(), first.capacity() * sizeof(std::int64_t));
  advise_huge_pages(corner.data(), corner.capacity() * sizeof(Index));
}

}  // namespace ibmfair
