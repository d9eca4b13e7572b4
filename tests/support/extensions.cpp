#include "support/extensions.h"

#include <algorithm>
#include <array>

#include "support/mesh_io.h"

namespace ibmfair::test {
namespace {

/// The weights 1/2, 1/4, ... with the last weight twice, beginning with corner `first` of `count`.
Eigen::VectorXd halving(std::size_t count, std::size_t first) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  double weight = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 1 < count) weight /= 2.0;
    weights[static_cast<Eigen::Index>((first + i) % count)] += weight;
  }
  return weights;
}

}  // namespace

Tents::Tents(const Mesh& mesh, const std::vector<Index>& faces) {
  std::vector<Index>& rim = extension.rim;
  for (const Index f : faces)
    rim.insert(rim.end(), mesh.faces[f].begin(), mesh.faces[f].end());
  // The rim is not in the order of the file, so that an implementation that assumes this order
  // fails.
  std::sort(rim.rbegin(), rim.rend());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  const auto place = [&](Index v) { return std::find(rim.begin(), rim.end(), v) - rim.begin(); };

  const auto count = static_cast<Eigen::Index>(3 * faces.size());
  weights.setZero(count, static_cast<Eigen::Index>(rim.size()));
  extension.X.setZero(count, 3);
  std::vector<std::array<Index, 3>> triangles;
  Eigen::Index row = 0;
  for (const Index f : faces) {
    const std::span<const Index> corners = mesh.faces[f];
    const auto p = static_cast<Index>(mesh.X.rows() + row);
    for (std::size_t k = 0; k < 3; ++k, ++row) {
      const Eigen::VectorXd mean = halving(corners.size(), k);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        weights(row, place(corners[i])) += mean[static_cast<Eigen::Index>(i)];
        extension.X.row(row) += mean[static_cast<Eigen::Index>(i)] * mesh.X.row(corners[i]);
      }
      extension.X(row, 2) += 1.0 / (3.0 + static_cast<double>(k));
    }
    const Index q = p + 1;
    const Index r = p + 2;
    for (std::size_t i = 1; i < corners.size(); ++i)
      triangles.push_back({corners[i], corners[(i + 1) % corners.size()], p});
    triangles.push_back({corners[0], corners[1], q});
    triangles.push_back({corners[1], p, q});
    triangles.push_back({p, corners[0], q});
    triangles.push_back({p, q, r});
    extension.model_face.resize(triangles.size(), f);
  }
  extension.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i)
      extension.F(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(i)) = triangles[f][i];
  }
  extension.extend = [W = weights](const Eigen::MatrixXd& at_rim) -> Eigen::MatrixXd {
    return W * at_rim;
  };
}

std::string with_tent(std::string_view bytes, const std::string& name, Index face,
                      WriteReport* report, const WriteOptions& options) {
  MeshFiles files;
  const MeshFile file = MeshFiles::read(bytes, name);
  return files.write(file, file.mesh().X, Tents(file.mesh(), {face}).extension, name, options,
                     report);
}

std::vector<Index> some_faces(const Mesh& mesh, Index step) {
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.faces.size(); f += step)
    faces.push_back(f);
  return faces;
}

}  // namespace ibmfair::test
