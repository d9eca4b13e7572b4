#include "commands/picture.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/picture/field_picture.h"
#include "ibmfair/picture/png.h"

namespace ibmfair::commands {
namespace {

constexpr const char* no_colour = "none";

Image draw_plain(std::span<const FieldState> states, Eigen::Index patch_from,
                 const RenderOptions& rendering) {
  std::vector<PaintedMesh> meshes;
  for (const FieldState& state : states) {
    meshes.push_back({state.X, state.topology.F, {.marked_from = patch_from}});
  }
  return render_side_by_side(meshes, rendering);
}

/// The message about a name of a picture that promises another format; empty if it does not.
std::string wrong_extension(const std::string& path) {
  const std::string extension = path_extension(path);
  return extension.empty() || extension == "png"
             ? ""
             : fmt::format("'{}' must end in .png, because the picture is a PNG file", path);
}

}  // namespace

void add_picture_options(CLI::App& app, const std::string& what, PictureOptions& options) {
  std::vector<std::string> names{no_colour};
  for (const SurfaceField& field : surface_fields()) {
    names.emplace_back(field.name);
  }
  auto* picture = app.add_option("--picture", options.path, "draw " + what + " into this PNG file")
                      ->type_name(file_to_write)
                      ->check(CLI::Validator(wrong_extension, ""));
  note_of(app, *picture).extensions = {"png"};
  app.add_option("--picture-colour", options.colour,
                 "colour the picture by this quantity, with a legend below")
      ->check(CLI::IsMember(names))
      ->capture_default_str()
      ->needs(picture);
}

void draw_picture(const PictureOptions& options, bool overwrite, std::span<const FieldState> states,
                  Eigen::Index patch_from, const RenderOptions& rendering) {
  if (options.path.empty()) {
    return;
  }
  AtomicFile file(options.path, overwrite);
  file.write(encode_png(options.colour == no_colour
                            ? draw_plain(states, patch_from, rendering)
                            : render_field(surface_field(options.colour), states, rendering)));
  file.commit();
}

}  // namespace ibmfair::commands
