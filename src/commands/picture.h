// The picture that commands draw of what they did.
#pragma once

#include <span>
#include <string>

#include "ibmfair/measure/surface_fields.h"

namespace CLI {
class App;
}

namespace ibmfair::commands {

struct PictureOptions {
  std::string path;             ///< of a PNG file; empty: none
  std::string colour = "none";  ///< a name from surface_fields(), or none
};

/// --picture, --picture-colour. `what` says what is drawn.
void add_picture_options(CLI::App& app, const std::string& what, PictureOptions& options);

/// The states beside each other, in colours if the options want some; without, triangles from
/// `patch_from` on are marked. Does nothing where no picture is wanted.
void draw_picture(const PictureOptions& options, bool overwrite, std::span<const FieldState> states,
                  Eigen::Index patch_from);

}  // namespace ibmfair::commands
