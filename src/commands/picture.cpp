#include "commands/picture.h"

#include <algorithm>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/picture/field_picture.h"
#include "ibmfair/picture/png.h"
#include "ibmfair/picture/render.h"

namespace ibmfair::commands {
namespace {

constexpr Rgb patch_colour{240, 190, 120};
constexpr const char* no_colour = "none";

Image draw_plain(std::span<const FieldState> states, Eigen::Index patch_from) {
  std::vector<PaintedMesh> meshes;
  for (const FieldState& state : states) {
    const Triangles& F = state.topology.F;
    Paint paint;
    if (F.rows() > patch_from) {
      paint.triangle.assign(static_cast<std::size_t>(F.rows()), paint.front);
      std::fill(paint.triangle.begin() + patch_from, paint.triangle.end(), patch_colour);
    }
    meshes.push_back({state.X, F, paint});
  }
  return render_side_by_side(meshes);
}

}  // namespace

void add_picture_options(CLI::App& app, const std::string& what, PictureOptions& options) {
  std::vector<std::string> names{no_colour};
  for (const SurfaceField& field : surface_fields()) {
    names.emplace_back(field.name);
  }
  auto* picture = app.add_option("--picture", options.path, "draw " + what + " into this PNG file")
                      ->type_name(file_to_write);
  note_of(app, *picture).extensions = {"png"};
  app.add_option("--picture-colour", options.colour,
                 "colour the picture by this quantity, with a legend below")
      ->check(CLI::IsMember(names))
      ->capture_default_str()
      ->needs(picture);
}

void draw_picture(const PictureOptions& options, bool overwrite, std::span<const FieldState> states,
                  Eigen::Index patch_from) {
  if (options.path.empty()) {
    return;
  }
  AtomicFile file(options.path, overwrite);
  file.write(encode_png(options.colour == no_colour
                            ? draw_plain(states, patch_from)
                            : render_field(surface_field(options.colour), states)));
  file.commit();
}

}  // namespace ibmfair::commands
