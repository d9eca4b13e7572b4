// The values of options that take one number per vertex.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

/// Parses the whole word as a number; returns nothing if the word is not a finite number.
std::optional<double> finite_number(std::string_view word);

/// Returns #V numbers, one per vertex in order, from the text file `source` (separated as in
/// for_words) or, if there is no such file, from the vertex property `source` of the mesh. Throws
/// BadOption if `source` is neither. Throws BadFile, with line and text, for a word that is not a
/// finite number of at least `least`, and if there are not exactly #V numbers. All messages start
/// with `option`.
Eigen::VectorXd vertex_values(const MeshFile& file, const std::string& source, double least,
                              const std::string& option);

/// Like `vertex_values`, without a lower bound. `source` may also be a single number, which applies
/// to all vertices.
Eigen::VectorXd vertex_values_or_number(const MeshFile& file, const std::string& source,
                                        const std::string& option);

/// Throws BadFile, with a message as from `vertex_values`, if `value`, the property's value at this
/// vertex of the file, is not a finite number of at least `least`.
void require_vertex_value(double value, double least, std::int64_t vertex, const std::string& file,
                          const std::string& property, const std::string& option);

}  // namespace ibmfair::commands
