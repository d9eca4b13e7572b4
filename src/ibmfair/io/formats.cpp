#include "ibmfair/io/formats.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "ibmfair/io/assimp_import.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/ply.h"
#include "ibmfair/io/stl.h"
#include "ibmfair/io/threemf.h"

namespace ibmfair {
namespace {

constexpr std::string_view gzip_extension = ".gz";

Format through_assimp(std::string_view name, std::string_view title,
                      std::vector<std::string_view> extensions) {
  return {.name = name,
          .title = title,
          .extensions = std::move(extensions),
          .read = read_through_assimp};
}

std::vector<Format> make_formats() {
  Format stl = through_assimp("stl", "STL", {"stl"});
  stl.always_weld = true;
  stl.read = stl::read;
  stl.recognises = stl::recognises;
  stl.generate = stl::generate;
  Format gltf = through_assimp("gltf", "glTF", {"gltf", "glb", "vrm"});
  gltf.recognises = [](std::string_view bytes) { return bytes.starts_with("glTF"); };
  return {{.name = "ply",
           .title = "PLY",
           .extensions = {"ply"},
           .declares_types = true,
           .recognises = ply::recognises,
           .read = ply::read,
           .read_attributes = ply::read_attributes,
           .vertex_mask = ply::vertex_mask,
           .vertex_values = ply::vertex_values,
           .edit_faces = ply::edit_faces,
           .patch = ply::patch,
           .generate = ply::generate},
          {.name = "off",
           .title = "OFF",
           .extensions = {"off", "coff", "noff", "stoff", "cnoff"},
           .recognises = off::recognises,
           .read = off::read,
           .read_attributes = off::read_attributes,
           .edit_faces = off::edit_faces,
           .patch = off::patch,
           .generate = off::generate},
          {.name = "obj",
           .title = "Wavefront OBJ",
           .extensions = {"obj"},
           .recognises = obj::recognises,
           .read = obj::read,
           .read_attributes = obj::read_attributes,
           .vertex_mask = obj::vertex_mask,
           .edit_faces = obj::edit_faces,
           .patch = obj::patch,
           .generate = obj::generate},
          stl,
          gltf,
          through_assimp("3ds", "3D Studio", {"3ds"}),
          through_assimp("dae", "Collada", {"dae"}),
          through_assimp("fbx", "FBX", {"fbx"}),
          {.name = "3mf",
           .title = "3MF",
           .extensions = {"3mf"},
           .recognises = threemf::recognises,
           .read = threemf::read},
          through_assimp("amf", "AMF", {"amf"}),
          through_assimp("x3d", "X3D", {"x3d", "x3db"}),
          through_assimp("blend", "Blender", {"blend"}),
          through_assimp("assimp", "any other format that assimp reads",
                         {"ac",   "ase", "assbin", "b3d",  "bvh", "cob", "csm", "dxf",     "hmp",
                          "ifc",  "iqm", "irr",    "lwo",  "lws", "md2", "md3", "md5mesh", "mdl",
                          "ms3d", "ndo", "nff",    "ogex", "q3o", "sib", "smd", "ter",     "x"})};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

template <class Wanted>
std::string joined_names(const Wanted& wanted) {
  std::string names;
  for (const Format& format : formats()) {
    if (!wanted(format)) continue;
    if (!names.empty()) names += ", ";
    names += format.name;
  }
  return names;
}

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> table = make_formats();
  return table;
}

const Format* find_format(std::string_view name_or_extension) {
  const std::string wanted = lower_case(name_or_extension);
  for (const Format& format : formats()) {
    const auto& extensions = format.extensions;
    if (format.name == wanted ||
        std::find(extensions.begin(), extensions.end(), wanted) != extensions.end()) {
      return &format;
    }
  }
  return nullptr;
}

bool is_gzip_name(std::string_view path) {
  return path.size() > gzip_extension.size() &&
         lower_case(path.substr(path.size() - gzip_extension.size())) == gzip_extension;
}

std::string path_extension(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  if (is_gzip_name(path)) path.remove_suffix(gzip_extension.size());
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string() : lower_case(path.substr(dot + 1));
}

std::string writable_formats() {
  return joined_names([](const Format& format) { return format.generate != nullptr; });
}

std::string readable_formats() {
  return joined_names([](const Format& format) { return &format != &formats().back(); });
}

}  // namespace ibmfair
