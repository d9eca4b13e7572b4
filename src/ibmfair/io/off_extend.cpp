// Counts and vertex values for an extension of an OFF file, text or binary.
#include <unordered_set>

#include "ibmfair/io/extend_values.h"
#include "ibmfair/io/numbers.h"
#include "ibmfair/io/off.h"

namespace ibmfair::off {
namespace {

/// An edge as one number, which does not depend on the order of the vertices.
std::uint64_t edge(Index a, Index b) {
  const auto [low, high] = std::minmax(a, b);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
}

/// The number of edges of the new faces that are not edges of the source.
std::int64_t count_new_edges(const Mesh& mesh, const Extension& extension) {
  std::unordered_set<std::uint64_t> edges;
  std::vector<std::uint8_t> touched(static_cast<std::size_t>(mesh.X.rows()), 0);
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Index v = extension.F(f, i);
      edges.insert(edge(v, extension.F(f, (i + 1) % 3)));
      if (v < mesh.X.rows()) touched[v] = 1;
    }
  }
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    Index previous = mesh.faces[f].back();
    for (const Index v : mesh.faces[f]) {
      const bool near = touched[v] != 0 && touched[previous] != 0;
      if (near) edges.erase(edge(previous, v));
      previous = v;
    }
  }
  return static_cast<std::int64_t>(edges.size());
}

}  // namespace

void replace_counts(const std::array<std::int64_t, 3>& counts, const Layout& layout,
                    BytePatcher& file) {
  const std::array<std::int64_t, 3> old{layout.vertex_count, layout.face_count, layout.edge_count};
  for (std::size_t i = 0; i < 3; ++i) {
    if (counts[i] == old[i]) continue;
    std::string text;
    append_integer(text, counts[i]);
    const std::string_view token = layout.count_texts[i];
    file.replace(token.data(), token.data() + token.size(), std::string_view(text));
  }
}

std::array<std::int64_t, 3> extended_counts(const PatchRequest& request, const Layout& layout) {
  std::array<std::int64_t, 3> counts{layout.vertex_count, layout.face_count, layout.edge_count};
  if (request.extension == nullptr) return counts;
  counts[0] += request.extension->X.rows();
  counts[1] += request.extension->F.rows();
  // Few programs write the number of edges. A number that is too large for the source's faces is
  // left unchanged.
  const auto most_edges = static_cast<std::int64_t>(request.mesh.faces.corner.size());
  if (counts[2] > 0 && counts[2] <= most_edges) {
    counts[2] += count_new_edges(request.mesh, *request.extension);
  }
  return counts;
}

Eigen::MatrixXd extend_columns(const PatchRequest& request, const Layout& layout,
                               const Eigen::MatrixXd& at_rim) {
  Eigen::MatrixXd values = extend_values(*request.extension, at_rim);
  if (layout.normal) {
    values.leftCols(3) =
        new_normals(request.mesh, request.X, *request.extension, at_rim.leftCols(3));
  }
  return values.array().isFinite().select(values, 0.0);
}

}  // namespace ibmfair::off
