#include "ibmfair/io/threemf_part.h"

#include <utility>

#include <fmt/format.h>

#include "ibmfair/io/xml_tags.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::threemf {
namespace {

/// Reads the elements in the order of the text, and keeps track of those that are open.
class PartReader {
 public:
  explicit PartReader(const SourceBytes& text) : text_(text), tags_(text) {}

  Part run() {
    bool complete = false;
    while (tags_.next()) {
      if (tags_.is_end()) {
        complete = complete || tags_.name() == "model";
        end();
      } else {
        start();
        if (tags_.is_empty()) end();
      }
    }
    if (!complete) fail_in_file(text_, "the text ends before </model>");
    return std::move(part_);
  }

 private:
  void start() {
    const std::string_view name = tags_.name();
    if (name == "vertex" && mesh_ != nullptr) {
      mesh_->X.push_back({tags_.real("x"), tags_.real("y"), tags_.real("z")});
      require_countable(mesh_->X.size());
    } else if (name == "triangle" && mesh_ != nullptr) {
      read_triangle();
    } else if (name == "mesh") {
      mesh_ = object_;
    } else if (name == "object") {
      start_object();
    } else if (name == "component" && object_ != nullptr) {
      object_->components.push_back(placement());
    } else if (name == "item") {
      part_.items.push_back(placement());
    } else if (name == "texture2dgroup") {
      texture_ = &part_.textures[tags_.integer("id")];
    } else if (name == "tex2coord" && texture_ != nullptr) {
      texture_->push_back({tags_.real("u"), tags_.real("v")});
      require_countable(texture_->size());
    }
  }

  void end() {
    if (tags_.name() == "mesh") mesh_ = nullptr;
    if (tags_.name() == "object") object_ = mesh_ = nullptr;
    if (tags_.name() == "texture2dgroup") texture_ = nullptr;
  }

  void start_object() {
    const std::int64_t id = tags_.integer("id");
    const auto [place, is_new] = part_.objects.try_emplace(id);
    if (!is_new) tags_.fail(fmt::format("there are two objects with the id {}", id));
    object_ = &place->second;
    mesh_ = nullptr;
    group_ = tags_.has("pid") ? tags_.integer("pid") : 0;
    row_ = tags_.has("pindex") ? static_cast<Index>(tags_.integer("pindex")) : 0;
  }

  void read_triangle() {
    std::array<Index, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      static constexpr std::array<std::string_view, 3> names{"v1", "v2", "v3"};
      const std::int64_t v = tags_.integer(names[i]);
      if (v >= std::ssize(mesh_->X)) {
        tags_.fail(fmt::format("there is no vertex {} (the object has {}, counted from 0)", v,
                               mesh_->X.size()));
      }
      corners[i] = static_cast<Index>(v);
    }
    mesh_->F.push_back(corners);
    require_countable(mesh_->F.size());
    mesh_->texture.push_back(texture_corners());
    const std::int64_t group = mesh_->texture.back().group;
    part_.has_colours = part_.has_colours || (group != 0 && !part_.textures.contains(group));
  }

  /// The property of the triangle, or else that of the object. Where p2 or p3 is missing, p1 holds
  /// for the corner.
  TextureCorners texture_corners() const {
    TextureCorners corners{group_, {row_, row_, row_}};
    if (tags_.has("pid")) corners.group = tags_.integer("pid");
    if (tags_.has("p1")) corners.row.fill(static_cast<Index>(tags_.integer("p1")));
    if (tags_.has("p2")) corners.row[1] = static_cast<Index>(tags_.integer("p2"));
    if (tags_.has("p3")) corners.row[2] = static_cast<Index>(tags_.integer("p3"));
    return corners;
  }

  Placement placement() const {
    Placement place{tags_.text("path"), tags_.integer("objectid"), {}};
    if (!tags_.has("transform")) return place;
    const std::vector<double> values = tags_.reals("transform");
    if (values.size() != 12) {
      tags_.fail(fmt::format("a transform needs 12 numbers, and this one has {}", values.size()));
    }
    for (std::size_t row = 0; row < 4; ++row) {
      const Eigen::RowVector3d x(values[3 * row], values[3 * row + 1], values[3 * row + 2]);
      if (row < 3) {
        place.transform.A.row(static_cast<Eigen::Index>(row)) = x;
      } else {
        place.transform.t = x;
      }
    }
    return place;
  }

  void require_countable(std::size_t count) const {
    if (static_cast<std::int64_t>(count) > most_elements) {
      tags_.fail(fmt::format("more than {} elements", most_elements));
    }
  }

  const SourceBytes& text_;
  XmlTags tags_;
  Part part_;
  Object* object_ = nullptr;                               // the open element <object>
  Object* mesh_ = nullptr;                                 // the object whose <mesh> is open
  std::vector<std::array<double, 2>>* texture_ = nullptr;  // the open <texture2dgroup>
  std::int64_t group_ = 0;                                 // the property of the open object
  Index row_ = 0;
};

}  // namespace

Transform combined(const Transform& inner, const Transform& outer) {
  return {inner.A * outer.A, inner.t * outer.A + outer.t};
}

Part read_part(const SourceBytes& text) {
  return PartReader(text).run();
}

}  // namespace ibmfair::threemf
