#include "ibmfair/io/formats.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "ibmfair/io/assimp_import.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/ply.h"

namespace ibmfair {
namespace {

using Extensions = std::span<const std::string_view>;

constexpr std::array<std::string_view, 1> obj_extensions{"obj"};
constexpr std::array<std::string_view, 1> ply_extensions{"ply"};
constexpr std::array<std::string_view, 5> off_extensions{"off", "coff", "noff", "stoff", "cnoff"};
constexpr std::array<std::string_view, 1> stl_extensions{"stl"};
constexpr std::array<std::string_view, 3> gltf_extensions{"gltf", "glb", "vrm"};
constexpr std::array<std::string_view, 1> threeds_extensions{"3ds"};
constexpr std::array<std::string_view, 1> collada_extensions{"dae"};
constexpr std::array<std::string_view, 1> fbx_extensions{"fbx"};
constexpr std::array<std::string_view, 1> threemf_extensions{"3mf"};
constexpr std::array<std::string_view, 1> amf_extensions{"amf"};
constexpr std::array<std::string_view, 2> x3d_extensions{"x3d", "x3db"};
constexpr std::array<std::string_view, 1> blend_extensions{"blend"};
constexpr std::array<std::string_view, 27> other_extensions{
    "ac",   "ase", "assbin", "b3d",  "bvh", "cob", "csm", "dxf",     "hmp",
    "ifc",  "iqm", "irr",    "lwo",  "lws", "md2", "md3", "md5mesh", "mdl",
    "ms3d", "ndo", "nff",    "ogex", "q3o", "sib", "smd", "ter",     "x"};

Format through_assimp(std::string_view name, std::string_view title, Extensions extensions) {
  Format format{.name = name, .title = title, .extensions = extensions};
  format.read = read_through_assimp;
  return format;
}

std::vector<Format> make_formats() {
  Format obj{.name = "obj", .title = "Wavefront OBJ", .extensions = obj_extensions};
  obj.recognises = obj::recognises;
  obj.read = obj::read;
  obj.read_attributes = obj::read_attributes;
  obj.vertex_mask = obj::vertex_mask;
  obj.patch = obj::patch;
  obj.generate = obj::generate;

  Format ply{.name = "ply", .title = "PLY", .extensions = ply_extensions};
  ply.recognises = ply::recognises;
  ply.read = ply::read;
  ply.read_attributes = ply::read_attributes;
  ply.vertex_mask = ply::vertex_mask;
  ply.vertex_values = ply::vertex_values;
  ply.patch = ply::patch;
  ply.generate = ply::generate;

  Format off{.name = "off", .title = "OFF", .extensions = off_extensions};
  off.recognises = off::recognises;
  off.read = off::read;
  off.read_attributes = off::read_attributes;
  off.patch = off::patch;
  off.generate = off::generate;

  Format stl = through_assimp("stl", "STL", stl_extensions);
  stl.always_weld = true;
  stl.recognises = [](std::string_view bytes) { return bytes.starts_with("solid "); };

  Format gltf = through_assimp("gltf", "glTF", gltf_extensions);
  gltf.recognises = [](std::string_view bytes) { return bytes.starts_with("glTF"); };

  return {ply,
          off,
          obj,
          stl,
          gltf,
          through_assimp("3ds", "3D Studio", threeds_extensions),
          through_assimp("dae", "Collada", collada_extensions),
          through_assimp("fbx", "FBX", fbx_extensions),
          through_assimp("3mf", "3MF", threemf_extensions),
          through_assimp("amf", "AMF", amf_extensions),
          through_assimp("x3d", "X3D", x3d_extensions),
          through_assimp("blend", "Blender", blend_extensions),
          through_assimp("assimp", "any other format that assimp reads", other_extensions)};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::span<const Format> formats() {
  static const std::vector<Format> table = make_formats();
  return table;
}

const Format* find_format(std::string_view name_or_extension) {
  const std::string wanted = lower_case(name_or_extension);
  for (const Format& format : formats()) {
    const Extensions extensions = format.extensions;
    if (format.name == wanted ||
        std::find(extensions.begin(), extensions.end(), wanted) != extensions.end()) {
      return &format;
    }
  }
  return nullptr;
}

std::string path_extension(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string() : lower_case(path.substr(dot + 1));
}

std::string writable_formats() {
  std::string names;
  for (const Format& format : formats()) {
    if (format.generate == nullptr) continue;
    if (!names.empty()) names += ", ";
    names += format.name;
  }
  return names;
}

}  // namespace ibmfair
