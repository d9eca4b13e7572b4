#include "ibmfair/page/shown_triangles.h"

#include <algorithm>

#include "ibmfair/measure/used_vertices.h"
#include "ibmfair/page/decimate.h"

namespace ibmfair {
namespace {

/// The patches of the triangles made by decimation: the patch of a triangle at their first corner.
std::vector<Index> patches_again(const Triangles& before, const std::vector<Index>& patch,
                                 const Triangles& after, Index vertices) {
  std::vector<Index> of_vertex(static_cast<std::size_t>(vertices), 0);
  for (Eigen::Index t = 0; t < before.rows(); ++t) {
    for (const Index v : before.row(t)) {
      of_vertex[v] = patch[t];
    }
  }
  std::vector<Index> result;
  for (Eigen::Index t = 0; t < after.rows(); ++t) {
    result.push_back(of_vertex[after(t, 0)]);
  }
  return result;
}

void renumber(ShownTriangles& shown, Index vertices) {
  shown.vertex = used_vertices(shown.F);
  std::vector<Index> number(static_cast<std::size_t>(vertices), -1);
  for (std::size_t i = 0; i < shown.vertex.size(); ++i) {
    number[shown.vertex[i]] = static_cast<Index>(i);
  }
  for (Index& corner : shown.F.reshaped<Eigen::RowMajor>()) {
    corner = number[corner];
  }
}

}  // namespace

ShownTriangles choose_triangles(const Points& X, const Triangles& F,
                                const std::vector<Index>& patch, Index most) {
  const auto vertices = static_cast<Index>(X.rows());
  const auto patches = static_cast<Eigen::Index>(patch.size());
  ShownTriangles shown;
  shown.patch = patch;
  shown.of_mesh = static_cast<Index>(F.rows() - patches);
  shown.F = F;
  if (F.rows() > most) {
    const Triangles of_patches = F.bottomRows(patches);
    const Triangles fewer_patches = decimate(X, of_patches, most / 2);
    const Triangles of_mesh = decimate(X, F.topRows(F.rows() - patches),
                                       most - std::min<Index>(most / 2, fewer_patches.rows()));
    if (fewer_patches.rows() < patches) {
      shown.patch = patches_again(of_patches, patch, fewer_patches, vertices);
    }
    shown.of_mesh = static_cast<Index>(of_mesh.rows());
    shown.F.resize(of_mesh.rows() + fewer_patches.rows(), 3);
    shown.F << of_mesh, fewer_patches;
    shown.decimated = true;
  }
  renumber(shown, vertices);
  return shown;
}

}  // namespace ibmfair
