#include "ibmfair/io/mesh_file.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"
#include "ibmfair/io/weld.h"

namespace ibmfair {

struct MeshFile::Contents {
  std::shared_ptr<const SourceBytes> bytes;
  const Format* format = nullptr;
  std::string extension;
  ParsedMesh parsed;
  std::optional<Weld> weld;       // set if vertices were merged
  std::optional<KeptFaces> kept;  // set if faces or corners were left out
  std::vector<std::pair<std::string, std::vector<double>>> values;  // not in the bytes

  const std::vector<double>* values_called(const std::string& name) const {
    for (const auto& [known, numbers] : values) {
      if (known == name) return &numbers;
    }
    return nullptr;
  }

  /// The mask of the vertices of the file.
  std::vector<std::uint8_t> file_mask(const std::string& name) const {
    if (const std::vector<double>* numbers = values_called(name)) {
      std::vector<std::uint8_t> mask;
      for (const double number : *numbers)
        mask.push_back(number != 0 ? 1 : 0);
      return mask;
    }
    if (format->vertex_mask == nullptr) {
      throw BadOption(fmt::format(
          "{}: {} files have no groups or vertex properties to select '{}' by; OBJ and PLY files "
          "have them",
          bytes->name(), format->title, name));
    }
    return format->vertex_mask(*bytes, weld ? unwelded() : parsed.mesh, name);
  }

  std::optional<std::vector<double>> file_values(const std::string& name) const {
    if (const std::vector<double>* numbers = values_called(name)) return *numbers;
    if (format->vertex_values == nullptr) return std::nullopt;
    return format->vertex_values(*bytes, name);
  }

  /// The mesh with the vertex numbers of the file, which attributes and masks use.
  Mesh unwelded() const { return format->read(*bytes, extension).mesh; }

  MeshAttributes file_attributes() const {
    if (parsed.attributes) return *parsed.attributes;
    if (format->read_attributes == nullptr) return {};
    return format->read_attributes(*bytes, weld ? unwelded() : parsed.mesh);
  }
};

namespace {

/// The format according to the options, the path or the content, and the extension, which some
/// readers need to tell formats apart.
std::pair<const Format*, std::string> choose_format(const SourceBytes& bytes,
                                                    const std::string& wanted) {
  if (!wanted.empty()) {
    const Format* format = find_format(wanted);
    if (format == nullptr) {
      throw BadOption(fmt::format("--input-format: unknown mesh format '{}' (one of: {})", wanted,
                                  readable_formats()));
    }
    const std::string extension = path_extension(bytes.path());
    return {format, find_format(extension) == format ? extension : wanted};
  }
  const std::string extension = path_extension(bytes.path());
  if (const Format* format = find_format(extension)) return {format, extension};
  for (const Format& format : formats()) {
    if (format.recognises != nullptr && format.recognises(bytes.view())) {
      return {&format, std::string(format.name)};
    }
  }
  if (bytes.size() == 0) fail_in_file(bytes, "the file is empty");
  fail_in_file(bytes,
               fmt::format("neither the name nor the first bytes tell the mesh format; name it "
                           "with --input-format (one of: {})",
                           readable_formats()));
}

void refuse_too_many_elements(const Mesh& mesh, const SourceBytes& bytes) {
  const auto faces = static_cast<std::int64_t>(mesh.faces.first.size()) - 1;
  const auto corners = static_cast<std::int64_t>(mesh.faces.corner.size());
  if (mesh.X.rows() > most_elements || faces > most_elements || corners > 3 * most_elements) {
    fail_in_file(bytes,
                 fmt::format("{} vertices and {} faces of {} corners: {} of each, with {} "
                             "corners, are the most that can be read",
                             mesh.X.rows(), faces, corners, most_elements, 3 * most_elements));
  }
}

void require_faces(const ParsedMesh& parsed, const SourceBytes& bytes) {
  if (parsed.mesh.faces.size() > 0 && parsed.mesh.X.rows() > 0) return;
  const UnknownStatements& unknown = parsed.unknown;
  fail_in_file(
      bytes,
      fmt::format("the mesh has no {}{}", parsed.mesh.X.rows() == 0 ? "vertices" : "faces",
                  unknown.count == 0 ? ""
                                     : fmt::format("; line {} starts with the unknown keyword "
                                                   "'{}' (such lines: {})",
                                                   unknown.line, unknown.keyword, unknown.count)));
}

/// Merges coincident vertices; leaves `result` empty if there are none.
void weld_vertices(ParsedMesh& parsed, std::optional<Weld>& result) {
  Weld weld = find_coincident_vertices(parsed.mesh.X);
  const std::size_t merged = weld.vertex.size() - weld.first.size();
  if (merged == 0) return;
  apply(weld, parsed.mesh);
  parsed.notes.push_back(
      fmt::format("merged {} vertices that lay exactly on others; the new vertices "
                  "are numbered in the order in which their positions first occur",
                  merged));
  result = std::move(weld);
}

/// Leaves out what belongs to faces and corners that were left out.
void keep(const KeptFaces& kept, MeshAttributes& attributes) {
  if (!attributes.corner_texture.empty()) {
    std::vector<Index> texture;
    texture.reserve(kept.corner.size());
    for (const std::int64_t corner : kept.corner)
      texture.push_back(attributes.corner_texture[corner]);
    attributes.corner_texture = std::move(texture);
  }
  for (auto& [face, statement] : attributes.face_statements) {
    const auto next = std::lower_bound(kept.face.begin(), kept.face.end(), face);
    face = static_cast<Index>(next - kept.face.begin());
  }
}

KeptFaces combined(const KeptFaces& first, const KeptFaces& then) {
  KeptFaces both;
  for (const Index face : then.face)
    both.face.push_back(first.face[face]);
  for (const std::int64_t corner : then.corner)
    both.corner.push_back(first.corner[corner]);
  return both;
}

std::int64_t count_collapsed_edges(const Polygons& faces, const Weld& weld) {
  std::vector<std::pair<Index, Index>> edges;
  for (Index f = 0; f < faces.size(); ++f) {
    Index previous = faces[f].back();
    for (const Index v : faces[f]) {
      if (v != previous && weld.vertex[v] == weld.vertex[previous]) {
        edges.emplace_back(std::min(v, previous), std::max(v, previous));
      }
      previous = v;
    }
  }
  std::sort(edges.begin(), edges.end());
  return std::unique(edges.begin(), edges.end()) - edges.begin();
}

}  // namespace

const Mesh& MeshFile::mesh() const {
  return contents_->parsed.mesh;
}
const Format& MeshFile::format() const {
  return *contents_->format;
}
const std::string& MeshFile::name() const {
  return contents_->bytes->name();
}
bool MeshFile::has_texture_coordinates() const {
  return contents_->parsed.has_texture_coordinates;
}
bool MeshFile::has_normals() const {
  return contents_->parsed.has_normals;
}
bool MeshFile::welded() const {
  return contents_->weld.has_value();
}
const std::vector<Index>& MeshFile::merged_vertices() const {
  static const std::vector<Index> none;
  return welded() ? contents_->weld->vertex : none;
}
const std::vector<std::string>& MeshFile::notes() const {
  return contents_->parsed.notes;
}
const std::vector<std::string>& MeshFile::warnings() const {
  return contents_->parsed.warnings;
}
const UnknownStatements& MeshFile::unknown_statements() const {
  return contents_->parsed.unknown;
}
const SourceBytes& MeshFile::bytes() const {
  return *contents_->bytes;
}

std::vector<std::uint8_t> MeshFile::vertex_mask(const std::string& name) const {
  std::vector<std::uint8_t> own = contents_->file_mask(name);
  if (!welded()) return own;
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(mesh().X.rows()), 0);
  for (std::size_t v = 0; v < own.size(); ++v) {
    if (own[v] != 0) mask[contents_->weld->vertex[v]] = 1;
  }
  return mask;
}

std::optional<std::vector<double>> MeshFile::vertex_values(const std::string& name) const {
  auto own = contents_->file_values(name);
  if (!own || !welded()) return own;
  std::vector<double> values(static_cast<std::size_t>(mesh().X.rows()));
  for (std::size_t v = own->size(); v-- > 0;) {
    values[contents_->weld->vertex[v]] = (*own)[v];
  }
  return values;
}

MeshFile MeshFile::with_positions(Points X) const {
  auto contents = std::make_shared<Contents>(*contents_);
  contents->parsed.mesh.X = std::move(X);
  MeshFile file;
  file.contents_ = std::move(contents);
  return file;
}

MeshFile MeshFile::with_values(std::string name, std::vector<double> values) const {
  auto contents = std::make_shared<Contents>(*contents_);
  contents->values.emplace(contents->values.begin(), std::move(name), std::move(values));
  MeshFile file;
  file.contents_ = std::move(contents);
  return file;
}

MeshFile MeshFile::merged_exactly() const {
  if (welded()) return *this;
  auto contents = std::make_shared<Contents>(*contents_);
  weld_vertices(contents->parsed, contents->weld);
  MeshFile file;
  file.contents_ = std::move(contents);
  return file;
}

MeshAttributes MeshFile::attributes() const {
  MeshAttributes attributes = contents_->file_attributes();
  if (!welded()) return attributes;
  if (contents_->kept) keep(*contents_->kept, attributes);
  if (!attributes.colours.empty()) {
    std::vector<std::array<double, 4>> colours;
    colours.reserve(contents_->weld->first.size());
    for (const Index v : contents_->weld->first) {
      colours.push_back(attributes.colours[v]);
    }
    attributes.colours = std::move(colours);
  }
  return attributes;
}

CloseWeld::CloseWeld(const MeshFile& source, double tolerance)
    : CloseWeld(source, find_close_vertices(source.mesh().X, tolerance)) {}

CloseWeld::CloseWeld(const MeshFile& source, const Weld& weld) : file(source) {
  const Points& X = source.mesh().X;
  merged = std::ssize(weld.vertex) - std::ssize(weld.first);
  if (merged == 0) return;
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    farthest = std::max(farthest, (X.row(v) - X.row(weld.first[weld.vertex[v]])).norm());
  }
  auto contents = std::make_shared<MeshFile::Contents>(*source.contents_);
  Mesh& mesh = contents->parsed.mesh;
  collapsed_edges = count_collapsed_edges(mesh.faces, weld);
  apply(weld, mesh);
  if (collapsed_edges > 0) {
    const Index faces = mesh.faces.size();
    const KeptFaces left = remove_collapsed(mesh.faces);
    contents->kept = contents->kept ? combined(*contents->kept, left) : left;
    collapsed_faces = faces - mesh.faces.size();
    if (mesh.faces.size() == 0) {
      throw BadMesh(fmt::format(
          "{}: --weld: no face is left; a smaller LENGTH merges fewer vertices", source.name()));
    }
  }
  contents->weld = contents->weld ? combined(*contents->weld, weld) : weld;
  file.contents_ = std::move(contents);
}

MeshFile read_mesh(const std::string& path, const ReadOptions& options) {
  return read_mesh(SourceBytes::read(path), options);
}

MeshFile read_mesh(std::shared_ptr<const SourceBytes> bytes, const ReadOptions& options) {
  auto contents = std::make_shared<MeshFile::Contents>();
  contents->bytes = std::move(bytes);
  std::tie(contents->format, contents->extension) = choose_format(*contents->bytes, options.format);
  ParsedMesh& parsed = contents->parsed;
  parsed = contents->format->read(*contents->bytes, contents->extension);
  refuse_too_many_elements(parsed.mesh, *contents->bytes);
  require_faces(parsed, *contents->bytes);
  if (options.weld || contents->format->always_weld) {
    weld_vertices(parsed, contents->weld);
  }
  MeshFile file;
  file.contents_ = std::move(contents);
  return file;
}

}  // namespace ibmfair
