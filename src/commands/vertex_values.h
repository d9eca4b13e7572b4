// Options that give every vertex a number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

/// The number that all of the word says; nothing where it says none, or one that is not finite.
std::optional<double> finite_number(std::string_view word);

/// #V numbers out of the text file `source`, one for each vertex in their order, separated as in
/// for_words; or, where there is no such file, the vertex property of the mesh of this name.
/// `option` starts the messages of what is thrown: BadOption where `source` is neither, BadFile
/// that names line and text of what is not a number from `least` on, or where there are not #V.
Eigen::VectorXd vertex_values(const MeshFile& file, const std::string& source, double least,
                              const std::string& option);

/// As `vertex_values`, for any finite numbers; `source` may also be a single number, for all
/// vertices.
Eigen::VectorXd vertex_values_or_number(const MeshFile& file, const std::string& source,
                                        const std::string& option);

/// Throws BadFile, in the words of these, where the value that the property has at a vertex of the
/// file is not a finite number from `least` on.
void require_vertex_value(double value, double least, std::int64_t vertex, const std::string& file,
                          const std::string& property, const std::string& option);

}  // namespace ibmfair::commands
