// The picture of a result that commands draw with --picture.
#pragma once

#include <span>
#include <string>

#include "ibmfair/measure/surface_fields.h"
#include "ibmfair/picture/render.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

struct PictureOptions {
  std::string path;             ///< path of a PNG file; empty: no picture
  std::string colour = "none";  ///< a name from surface_fields(), or "none"
};

/// Declares --picture and --picture-colour. `what` names the drawn object in the help.
void add_picture_options(CLI::App& app, const std::string& what, PictureOptions& options);

/// Draws the states beside each other, as `rendering` says, coloured by the quantity that the
/// options name. Without a quantity, marks the triangles from number `patch_from` on. Does nothing
/// if no picture was requested.
void draw_picture(const PictureOptions& options, bool overwrite, std::span<const FieldState> states,
                  Eigen::Index patch_from, const RenderOptions& rendering = {});

}  // namespace ibmfair::commands
