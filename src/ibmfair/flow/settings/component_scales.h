// One cut-off for components of different size.
#pragma once

#include "ibmfair/mesh/topology.h"

namespace ibmfair {

/// Factors of the cut-off at each vertex (#V, as FlowOptions::cutoff_factor), with which a cut-off
/// is as long on all components, measured in their own edges, but no longer than it is: the ratio
/// of the component's mean edge length to the largest one of a component with a fair share of the
/// vertices (ComponentTuning::share), and at most 1. Else a small part beside a large one would be
/// smoothed up to wavelengths as long as itself. Empty if no component has a ratio below
/// ComponentTuning::alike. `X`: #V x 3.
Eigen::VectorXd component_scales(const Points& X, const Topology& topology);

}  // namespace ibmfair
