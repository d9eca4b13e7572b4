// The data at the vertices of a mesh that the options of `smooth` name.
#pragma once

#include "commands/smooth_arguments.h"
#include "commands/smooth_plan.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/topology.h"

namespace ibmfair::commands {

/// The mesh of the file with the data at its vertices that the options name. The result refers to
/// `file` and `topology`. Throws as vertex_values, read_vertex_list and MeshFile::vertex_mask do.
SmoothInput smooth_input(const SmoothArguments& arguments, const MeshFile& file,
                         const Topology& topology);

}  // namespace ibmfair::commands
