// Pictures of meshes coloured by a field.
#pragma once

#include <span>

#include "ibmfair/measure/surface_fields.h"
#include "ibmfair/picture/render.h"

namespace ibmfair {

/// The states from left to right, coloured by `field`, and a legend below. The last one sets the
/// scale for all (see robust_range): noise that is gone shall not take the colours of what is left.
/// A triangle has the mean of its corners' values. A state that has no `before` stays plain where
/// the field needs one.
/// @throws BadOption as `render` does.
Image render_field(const SurfaceField& field, std::span<const FieldState> states,
                   const RenderOptions& options = {});

}  // namespace ibmfair
