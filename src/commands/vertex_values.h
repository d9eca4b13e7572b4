// Options that give every vertex a number.
#pragma once

#include <string>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair::commands {

/// #V numbers out of the text file `source`, one for each vertex in their order, separated as in
/// for_words; or, where there is no such file, the vertex property of the mesh of this name.
/// `option` starts the messages of what is thrown: BadOption where `source` is neither, BadFile
/// that names line and text of what is not a number from `least` on, or where there are not #V.
Eigen::VectorXd vertex_values(const MeshFile& file, const std::string& source, double least,
                              const std::string& option);

/// The same for any finite numbers; `source` may also be one, for all vertices.
Eigen::VectorXd vertex_values_or_number(const MeshFile& file, const std::string& source,
                                        const std::string& option);

}  // namespace ibmfair::commands
