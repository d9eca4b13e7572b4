// The library's usual path, from a file to a fairer file: read, connect, smooth or fill, write.
// What else there is has headers of its own.
#pragma once

#include "ibmfair/energy/bending_energy.h"  // IWYU pragma: export
#include "ibmfair/fill/fill_holes.h"        // IWYU pragma: export
#include "ibmfair/fill/fill_region.h"       // IWYU pragma: export
#include "ibmfair/flow/fixed_vertices.h"    // IWYU pragma: export
#include "ibmfair/flow/time_scale.h"        // IWYU pragma: export
#include "ibmfair/flow/willmore_flow.h"     // IWYU pragma: export
#include "ibmfair/io/mesh_file.h"           // IWYU pragma: export
#include "ibmfair/mesh/geometry.h"          // IWYU pragma: export
#include "ibmfair/mesh/mesh.h"              // IWYU pragma: export
#include "ibmfair/mesh/topology.h"          // IWYU pragma: export
