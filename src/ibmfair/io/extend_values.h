// Values of the new vertices of an extension, as the writers of all formats need them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "ibmfair/io/extension.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair {

/// Stands for a value that a vertex does not have (NaN).
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Throws BadMesh if the extension does not fit the mesh or has a coordinate that is not finite.
void require_fit(const Extension& extension, const Mesh& mesh);

/// The mesh with its vertices at X, followed by the vertices and faces of the extension.
Mesh extended_mesh(const Mesh& mesh, const Points& X, const Extension& extension);

/// Extends values at the rim (#rim x columns) to the new vertices (#new x columns). An entry that
/// is not finite is unknown. A new vertex gets the mean of the known values, with the weights of
/// Extension::extend, or unknown if no known value has a noticeable weight.
Eigen::MatrixXd extend_values(const Extension& extension, const Eigen::MatrixXd& at_rim);

/// For each new vertex, the nearest vertex of the source, where distance is the number of edges of
/// new faces; among several, the first one found. 0 for a vertex that no new face connects to the
/// source.
std::vector<Index> nearest_source_vertices(const Extension& extension, Index source_vertices);

/// Unit normals at the new vertices, #new vertices x 3, from the new faces around each; zero if
/// these have no area. They are oriented consistently with `at_rim` (#rim x 3, the file's normals
/// at the rim, or unknown), and unknown if no normal of the rim is near enough. `X` are the
/// positions at which the vertices of the source are written.
Points new_normals(const Mesh& mesh, const Points& X, const Extension& extension,
                   const Points& at_rim);

/// The numbers in ascending order, without repetitions.
template <class T>
std::vector<T> sorted_once(std::vector<T> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// The position of `number` in `sorted`, which is in ascending order and contains it.
template <class T>
std::size_t position_in(const std::vector<T>& sorted, T number) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), number) -
                                  sorted.begin());
}

/// Reorders the rows of `values`: they are in ascending order of the rim's vertices, as a pass over
/// a file finds them, and come out in the order of the rim itself.
Eigen::MatrixXd in_order_of_rim(const Extension& extension, const std::vector<Index>& sorted_rim,
                                const Eigen::MatrixXd& values);

}  // namespace ibmfair
