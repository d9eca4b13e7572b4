// Pictures of meshes coloured by a field.
#pragma once

#include <span>

#include "ibmfair/measure/surface_fields.h"
#include "ibmfair/picture/render.h"

namespace ibmfair {

/// The states from left to right, coloured by `field`, with a legend below. The last state
/// determines the colour scale for all of them (see robust_range), so that noise which is removed
/// in the last state does not use up the colours that are needed there. A triangle is coloured by
/// the mean of its corners' values. If the field needs `before`, states without it are drawn in
/// plain colour.
Image render_field(const SurfaceField& field, std::span<const FieldState> states,
                   const RenderOptions& options = {});

}  // namespace ibmfair
