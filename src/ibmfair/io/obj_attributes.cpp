// Reads the contents of an OBJ text besides positions and faces: texture coordinates, colours,
// groups.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/obj.h"
#include "ibmfair/io/obj_scanner.h"

namespace ibmfair::obj {
namespace {

/// Reads the numbers after x, y and z of a vertex, which are a colour if there are three or four.
void read_colour(ObjScanner& scan, Index vertex, MeshAttributes& attributes) {
  for (int c = 0; c < 3; ++c)
    scan.skip_number();
  std::array<double, 4> rgba{1, 1, 1, 1};
  int columns = 0;
  for (; !scan.at_statement_end(); ++columns) {
    const double value = scan.any_real();
    if (columns < 4) rgba[columns] = value;
  }
  if (columns != 3 && columns != 4) return;
  attributes.opacity = attributes.opacity || columns == 4;
  attributes.colours.resize(static_cast<std::size_t>(vertex), {1, 1, 1, 1});
  attributes.colours.push_back(rgba);
}

/// Reads the text once, keeps track of the names that apply to the current face, and marks the
/// vertices of all faces to which the wanted name applies.
class MaskReader {
 public:
  MaskReader(const SourceBytes& source, const Mesh& mesh, std::string_view wanted)
      : scan_(source), mesh_(mesh), wanted_(wanted) {}

  std::vector<std::uint8_t> run(const std::string& file) {
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(mesh_.X.rows()), 0);
    Index face = 0;
    while (scan_.next_statement()) {
      const std::string_view keyword = scan_.keyword();
      if (keyword == "g") {
        in_group_ = read_group();
      } else if (keyword == "o") {
        in_object_ = meet(scan_.rest());
      } else if (keyword == "usemtl") {
        in_material_ = meet(scan_.rest());
      } else if (keyword == "f") {
        if (in_group_ || in_object_ || in_material_) {
          for (const Index v : mesh_.faces[face])
            mask[v] = 1;
        }
        ++face;
      }
    }
    if (!names_.contains(std::string(wanted_))) fail(file);
    return mask;
  }

 private:
  bool meet(std::string_view name) {
    names_.emplace(name);
    return name == wanted_;
  }

  /// Reads a `g` statement, which may name several groups. The wanted name may also be the whole
  /// statement, so that a name with blanks is found.
  bool read_group() {
    ObjScanner whole = scan_;
    const std::string_view all = whole.rest();
    bool found = all == wanted_ && meet(all);
    while (!scan_.at_statement_end())
      found = meet(scan_.word()) || found;
    return found;
  }

  [[noreturn]] void fail(const std::string& file) const {
    std::string list;
    for (const std::string& name : names_)
      list += (list.empty() ? "" : ", ") + name;
    throw BadOption(fmt::format("{}: no group, object or material is called '{}'; there {}", file,
                                wanted_, list.empty() ? "are none" : "are: " + list));
  }

  ObjScanner scan_;
  const Mesh& mesh_;
  std::string_view wanted_;
  std::set<std::string> names_;
  bool in_group_ = false;
  bool in_object_ = false;
  bool in_material_ = false;
};

}  // namespace

Index resolve_reference(std::int64_t raw, std::size_t count_so_far) {
  const std::int64_t row = raw > 0 ? raw - 1 : static_cast<std::int64_t>(count_so_far) + raw;
  return raw == 0 || row < 0 || row >= std::int64_t{1} << 31 ? -1 : static_cast<Index>(row);
}

void drop_dangling(std::vector<Index>& references, std::int64_t count) {
  std::replace_if(
      references.begin(), references.end(), [&](Index row) { return row >= count; }, -1);
}

bool is_face_statement(std::string_view keyword) {
  return keyword == "g" || keyword == "o" || keyword == "usemtl" || keyword == "mtllib" ||
         keyword == "s";
}

CornerReferences read_corner_references(const SourceBytes& source) {
  CornerReferences result;
  ObjScanner scan(source);
  while (scan.next_statement()) {
    const std::string_view keyword = scan.keyword();
    if (keyword == "vt") {
      const double u = scan.any_real();
      result.texture_coordinates.push_back({u, scan.at_statement_end() ? 0.0 : scan.any_real()});
    } else if (keyword == "vn") {
      const double x = scan.any_real();
      const double y = scan.any_real();
      result.normals.push_back({x, y, scan.any_real()});
    } else if (keyword == "f") {
      while (!scan.at_statement_end()) {
        const RawCorner corner = scan.corner();
        result.corner_texture.push_back(
            resolve_reference(corner.texture, result.texture_coordinates.size()));
        result.corner_normal.push_back(resolve_reference(corner.normal, result.normals.size()));
      }
    }
  }
  drop_dangling(result.corner_texture, std::ssize(result.texture_coordinates));
  drop_dangling(result.corner_normal, std::ssize(result.normals));
  return result;
}

MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh) {
  MeshAttributes attributes;
  CornerReferences references = read_corner_references(source);
  attributes.normals = !references.normals.empty();
  if (!references.texture_coordinates.empty()) {
    attributes.texture_coordinates = std::move(references.texture_coordinates);
    attributes.corner_texture = std::move(references.corner_texture);
  }
  std::set<std::string, std::less<>> others;
  ObjScanner scan(source);
  Index vertex = 0;
  Index face = 0;
  while (scan.next_statement()) {
    const std::string_view keyword = scan.keyword();
    if (keyword == "v") {
      read_colour(scan, vertex++, attributes);
    } else if (keyword == "f") {
      ++face;
    } else if (is_face_statement(keyword)) {
      attributes.face_statements.emplace_back(face, fmt::format("{} {}", keyword, scan.rest()));
    } else if (keyword != "vt" && keyword != "vn") {
      others.emplace(keyword);
    }
  }
  if (!attributes.colours.empty()) {
    attributes.colours.resize(static_cast<std::size_t>(mesh.X.rows()), {1, 1, 1, 1});
  }
  for (const std::string& keyword : others) {
    attributes.uncarried.push_back(fmt::format("'{}' statements", keyword));
  }
  if (source.view().find('#') != std::string_view::npos) {
    attributes.uncarried.emplace_back("comments");
  }
  return attributes;
}

std::vector<std::uint8_t> vertex_mask(const SourceBytes& source, const Mesh& mesh,
                                      std::string_view name) {
  return MaskReader(source, mesh, name).run(source.name());
}

}  // namespace ibmfair::obj
