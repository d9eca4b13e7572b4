// What the formats share in writing an extension: the values that its vertices get.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "ibmfair/io/extension.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Stands for a value that a vertex does not have.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Throws BadMesh where the extension does not fit the mesh or has a coordinate that is not finite.
void require_fit(const Extension& extension, const Mesh& mesh);

/// The mesh with its vertices at X and the extension behind them.
Mesh extended_mesh(const Mesh& mesh, const Points& X, const Extension& extension);

/// Values at the rim (#rim x columns) extended to the new vertices (#new x columns). An entry that
/// is not finite is unknown: a new vertex gets the mean of those that are known, weighted as
/// Extension::extend weights them, or unknown where none of them reaches it.
Eigen::MatrixXd extend_values(const Extension& extension, const Eigen::MatrixXd& at_rim);

/// #new vertices: the source's vertex that is nearest in edges of the new faces; of several the one
/// met first. 0 for a vertex that no new face connects to the source.
std::vector<Index> nearest_source_vertices(const Extension& extension, Index source_vertices);

/// #new vertices x 3, of length 1 (zero without area around): the normals of the new faces, turned
/// to the side of `at_rim` (#rim x 3, the file's normals of the rim's vertices, or unknown);
/// unknown where no normal of the rim reaches. `X` is where the source's vertices are written.
Points new_normals(const Mesh& mesh, const Points& X, const Extension& extension,
                   const Points& at_rim);

/// The numbers in ascending order, each once.
template <class T>
std::vector<T> sorted_once(std::vector<T> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// Where `number` stands among numbers in ascending order, which have it.
template <class T>
std::size_t position_in(const std::vector<T>& sorted, T number) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), number) -
                                  sorted.begin());
}

/// Rows of values that were met in ascending order of the rim's vertices, as files are read, in the
/// order of the rim itself.
Eigen::MatrixXd in_order_of_rim(const Extension& extension, const std::vector<Index>& sorted_rim,
                                const Eigen::MatrixXd& values);

}  // namespace ibmfair
