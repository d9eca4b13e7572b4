// Finds the model in a 3MF package, and places its objects.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/process_memory.h"
#include "ibmfair/io/threemf.h"
#include "ibmfair/io/threemf_part.h"
#include "ibmfair/io/xml_tags.h"
#include "ibmfair/io/zip_archive.h"

namespace ibmfair::threemf {
namespace {

constexpr std::string_view relations = "_rels/.rels";
constexpr std::string_view model_relation = "/3dmodel";  // how the type of the relation ends
constexpr std::string_view usual_model = "3D/3dmodel.model";
constexpr std::int64_t most_placements = 100'000;
constexpr std::size_t deepest = 1000;

/// The name of a part as the archive has it.
std::string without_slash(const std::string& name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

/// The name of the part that the package names as its model.
std::string model_name(const ZipArchive& archive, const SourceBytes& source) {
  if (archive.has(relations)) {
    const auto text = archive.read(relations);
    for (XmlTags tags(*text); tags.next();) {
      if (tags.is_start() && tags.name() == "Relationship" &&
          tags.text("Type").ends_with(model_relation)) {
        return without_slash(tags.text("Target"));
      }
    }
  }
  if (!archive.has(usual_model)) {
    fail_in_file(source, fmt::format("the package names no model in {}, and has no {}", relations,
                                     usual_model));
  }
  return std::string(usual_model);
}

class PackageReader {
 public:
  explicit PackageReader(const SourceBytes& source)
      : source_(source), archive_(source), model_(model_name(archive_, source)) {}

  ParsedMesh run() {
    const Part& model = part(model_);
    std::vector<Placement> items = model.items;
    if (items.empty()) items = objects_that_no_other_has(model);
    for (const Placement& item : items) {
      place(item.part.empty() ? model_ : without_slash(item.part), item.object, item.transform);
    }
    ParsedMesh parsed;
    parsed.mesh.X = Eigen::Map<const Points>(X_.empty() ? nullptr : X_.front().data(),
                                             static_cast<Eigen::Index>(X_.size()), 3);
    parsed.mesh.faces = std::move(faces_);
    MeshAttributes attributes;
    if (!texture_.empty()) {
      attributes.texture_coordinates = std::move(texture_);
      attributes.corner_texture = std::move(corner_texture_);
    }
    if (has_colours_) attributes.uncarried.emplace_back("colours and materials");
    parsed.has_texture_coordinates = !attributes.texture_coordinates.empty();
    parsed.attributes = std::move(attributes);
    if (model.items.empty() && !items.empty()) {
      parsed.notes.emplace_back("the build of the package is empty: all its objects are read");
    }
    if (placements_ > 1) {
      parsed.notes.push_back(fmt::format(
          "the package has {} placed objects; their vertices and faces are numbered one object "
          "after the other",
          placements_));
    }
    return parsed;
  }

 private:
  const Part& part(const std::string& name) {
    const auto known = parts_.find(name);
    if (known != parts_.end()) return known->second;
    return parts_.emplace(name, read_part(*archive_.read(name))).first->second;
  }

  static std::vector<Placement> objects_that_no_other_has(const Part& model) {
    std::set<std::int64_t> components;
    for (const auto& [id, object] : model.objects) {
      for (const Placement& component : object.components)
        components.insert(component.object);
    }
    std::vector<Placement> items;
    for (const auto& [id, object] : model.objects) {
      if (!components.contains(id)) items.push_back({"", id, {}});
    }
    return items;
  }

  /// Adds the object and its components.
  void place(const std::string& part_name, std::int64_t id, const Transform& transform) {
    const Part& holder = part(part_name);
    const auto found = holder.objects.find(id);
    if (found == holder.objects.end()) {
      fail_in_file(source_, fmt::format("{}: there is no object {}", part_name, id));
    }
    if (std::ranges::find(open_, &found->second) != open_.end()) {
      fail_in_file(source_, fmt::format("{}: object {} is a component of itself", part_name, id));
    }
    if (++visits_ > most_placements) {
      fail_in_file(source_, fmt::format("more than {} placed objects", most_placements));
    }
    if (open_.size() == deepest) {
      fail_in_file(source_, fmt::format("components are nested more than {} deep", deepest));
    }
    open_.push_back(&found->second);
    add(holder, found->second, transform);
    for (const Placement& component : found->second.components) {
      place(component.part.empty() ? part_name : without_slash(component.part), component.object,
            combined(component.transform, transform));
    }
    open_.pop_back();
  }

  void add(const Part& holder, const Object& object, const Transform& transform) {
    if (object.F.empty()) return;
    ++placements_;
    const auto first = static_cast<std::int64_t>(X_.size());
    if (first + std::ssize(object.X) > most_elements ||
        faces_.size() + std::ssize(object.F) > most_elements) {
      fail_in_file(source_, fmt::format("more than {} vertices or faces", most_elements));
    }
    require_memory(first + std::ssize(object.X), faces_.size() + std::ssize(object.F));
    for (const std::array<double, 3>& x : object.X) {
      const Eigen::RowVector3d at = transform(Eigen::RowVector3d(x[0], x[1], x[2]));
      if (!at.allFinite()) {
        fail_in_file(source_,
                     fmt::format("vertex {} has a coordinate that is not finite", X_.size()));
      }
      X_.push_back({at[0], at[1], at[2]});
    }
    // A mirrored object is turned inside out, so that its orientation stays outward.
    const bool mirrored = transform.A.determinant() < 0;
    for (std::size_t f = 0; f < object.F.size(); ++f) {
      std::array<Index, 3> corners = object.F[f];
      std::array<Index, 3> rows = texture_rows(holder, object.texture[f]);
      for (Index& v : corners)
        v += static_cast<Index>(first);
      if (mirrored) {
        std::swap(corners[1], corners[2]);
        std::swap(rows[1], rows[2]);
      }
      faces_.add(corners);
      corner_texture_.insert(corner_texture_.end(), rows.begin(), rows.end());
    }
    has_colours_ = has_colours_ || holder.has_colours;
  }

  /// Throws OutOfMemory if a mesh of this size does not fit into the memory: a small package can
  /// place a large object many times. Lists that grow take up to twice the size of their contents.
  void require_memory(std::int64_t vertices, std::int64_t faces) {
    constexpr double bytes_per_vertex = 24, bytes_per_face = 3 * 4 + 8 + 3 * 4;
    const double bytes = bytes_per_vertex * static_cast<double>(vertices) +
                         bytes_per_face * static_cast<double>(faces);
    if (bytes <= checked_bytes_) return;
    checked_bytes_ = 2 * bytes;
    require_available(checked_bytes_, source_.name());
  }

  /// The rows of texture_ for the corners of a triangle; -1 for corners without texture.
  std::array<Index, 3> texture_rows(const Part& holder, const TextureCorners& corners) {
    const auto group = holder.textures.find(corners.group);
    if (group == holder.textures.end()) return {-1, -1, -1};
    auto [first, is_new] = first_row_.try_emplace(&group->second, texture_.size());
    if (is_new) texture_.insert(texture_.end(), group->second.begin(), group->second.end());
    std::array<Index, 3> rows{-1, -1, -1};
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners.row[i] < std::ssize(group->second)) {
        rows[i] = static_cast<Index>(first->second) + corners.row[i];
      }
    }
    return rows;
  }

  const SourceBytes& source_;
  ZipArchive archive_;
  std::string model_;
  std::map<std::string, Part> parts_;
  std::vector<const Object*> open_;  // the objects that are being placed, each within the last
  std::int64_t visits_ = 0;
  std::int64_t placements_ = 0;  // of objects with triangles
  std::vector<std::array<double, 3>> X_;
  Polygons faces_;
  std::vector<std::array<double, 2>> texture_;
  std::vector<Index> corner_texture_;
  std::map<const void*, std::size_t> first_row_;  // of the groups in texture_
  bool has_colours_ = false;
  double checked_bytes_ = 0;  // that are known to fit into the memory
};

}  // namespace

bool recognises(std::string_view bytes) {
  return bytes.starts_with("PK\3\4") && bytes.find(".model") != std::string_view::npos;
}

ParsedMesh read(const SourceBytes& source, std::string_view /*extension*/) {
  return PackageReader(source).run();
}

}  // namespace ibmfair::threemf
