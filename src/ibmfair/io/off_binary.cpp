// Binary OFF. Geomview writes it big-endian, with a number of colour values after each face; PMP
// writes it little-endian and without that number; mixtures exist. Nothing in the file states the
// dialect, so the right one is the one in which the faces end exactly at the end of the file.
#include <bit>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/extend_values.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair::off {
namespace {

constexpr std::int64_t word = 4;  // every number in the file has four bytes
constexpr std::int64_t counts = 3 * word;

std::int64_t vertex_row(const Layout& layout) {
  return word * (3 + layout.extra_columns());
}

std::int32_t integer(const char* p, const Layout& layout) {
  return load<std::int32_t>(p, layout.swapped);
}

/// Reads the counts; false if the file is too short for that many rows.
bool read_counts(const SourceBytes& source, Layout& layout) {
  const std::int64_t room = source.end() - layout.body - counts;
  if (room < 0) return false;
  layout.vertex_count = integer(layout.body, layout);
  layout.face_count = integer(layout.body + word, layout);
  layout.edge_count = integer(layout.body + 2 * word, layout);
  return layout.vertex_count >= 0 && layout.face_count >= 0 &&
         layout.vertex_count * vertex_row(layout) + layout.face_count * word <= room;
}

const char* first_face(const Layout& layout) {
  return layout.body + counts + layout.vertex_count * vertex_row(layout);
}

/// The end of the face that starts at `p`; nullptr if it would end after the file.
const char* skip_face(const SourceBytes& source, const Layout& layout, const char* p) {
  for (int list = 0; list < (layout.colour_counts ? 2 : 1); ++list) {
    if (source.end() - p < word) return nullptr;
    const std::int64_t count = integer(p, layout);
    p += word;
    if (count < 0 || count > (source.end() - p) / word) return nullptr;
    p += count * word;
  }
  return p;
}

bool ends_with_file(const SourceBytes& source, const Layout& layout) {
  const char* p = first_face(layout);
  for (std::int64_t f = 0; f < layout.face_count && p != nullptr; ++f) {
    p = skip_face(source, layout, p);
  }
  return p == source.end();
}

void find_dialect(const SourceBytes& source, Layout& layout) {
  for (const bool little : {false, true}) {
    layout.swapped = little != (std::endian::native == std::endian::little);
    if (!read_counts(source, layout)) continue;
    for (const bool colour_counts : {true, false}) {
      layout.colour_counts = colour_counts;
      if (ends_with_file(source, layout)) return;
    }
  }
  fail_in_file(source,
               "binary OFF whose rows do not end with the file in either byte order: cut short, or "
               "of an unknown dialect");
}

void read_face(const SourceBytes& source, const Layout& layout, std::int64_t f, const char* p,
               Polygons& faces) {
  const std::int64_t count = integer(p, layout);
  if (count < 3) fail_in_binary(source, "face", f, p, "a face needs at least three corners");
  for (std::int64_t i = 1; i <= count; ++i) {
    const std::int64_t vertex = integer(p + i * word, layout);
    if (vertex < 0 || vertex >= layout.vertex_count) {
      fail_in_binary(source, "face", f, p + i * word,
                     fmt::format("there is no vertex {} (the file has {}, counted from 0)", vertex,
                                 layout.vertex_count));
    }
    faces.corner.push_back(static_cast<Index>(vertex));
  }
  faces.first.push_back(static_cast<std::int64_t>(faces.corner.size()));
}

/// Copies the rows of the vertices, with moved positions and stale normals replaced. Fills `at_rim`
/// (#rim x extra columns) with the values after the positions of the vertices in `rim`, which is in
/// ascending order.
void patch_vertices(const PatchRequest& request, const Layout& layout,
                    const std::vector<Index>& rim, Eigen::MatrixXd& at_rim, ByteSink& out) {
  std::optional<RenewedNormals> normals;
  if (layout.normal && request.any_moved) {
    normals.emplace(request.mesh.faces, request.mesh.X, request.X, request.moved);
  }
  const auto size = static_cast<std::size_t>(vertex_row(layout));
  Eigen::Index next_rim = 0;
  const char* row = layout.body + counts;
  for (std::int64_t v = 0; v < layout.vertex_count; ++v, row += size) {
    const auto store_row = [&](const char* old, const Vec3& value, bool replaced) {
      if (!replaced) return out.write({old, 3 * word});
      for (int c = 0; c < 3; ++c)
        store(out, static_cast<float>(value[c]), layout.swapped);
    };
    store_row(row, request.X.row(v), request.moved[v] != 0);
    std::size_t written = 3 * word;
    if (normals) {
      const char* old = row + written;
      Vec3 value;
      for (int c = 0; c < 3; ++c)
        value[c] = load<float>(old + c * word, layout.swapped);
      store_row(old, normals->renew(v, value), normals->is_stale(v));
      written += 3 * word;
    }
    out.write({row + written, size - written});
    const auto at = static_cast<std::size_t>(next_rim);
    if (at == rim.size() || rim[at] != v) continue;
    for (Eigen::Index c = 0; c < at_rim.cols(); ++c)
      at_rim(next_rim, c) = load<float>(row + (3 + c) * word, layout.swapped);
    ++next_rim;
  }
}

void append_vertices(const PatchRequest& request, const Layout& layout,
                     const std::vector<Index>& sorted_rim, const Eigen::MatrixXd& at_sorted_rim,
                     ByteSink& out) {
  const Extension& extension = *request.extension;
  const Eigen::MatrixXd columns =
      extend_columns(request, layout, in_order_of_rim(extension, sorted_rim, at_sorted_rim));
  for (Eigen::Index v = 0; v < extension.X.rows(); ++v) {
    for (int c = 0; c < 3; ++c)
      store(out, static_cast<float>(extension.X(v, c)), layout.swapped);
    for (Eigen::Index c = 0; c < columns.cols(); ++c)
      store(out, static_cast<float>(columns(v, c)), layout.swapped);
  }
}

/// Copies the rows of the faces and appends the new faces, with the colours of their model faces.
/// Returns the end of the faces in the source.
const char* append_faces(const PatchRequest& request, const Layout& layout, ByteSink& out) {
  const Extension& extension = *request.extension;
  const std::vector<Index> models = sorted_once(extension.model_face);
  std::vector<std::string_view> colours;
  const char* first = first_face(layout);
  const char* p = first;
  for (std::int64_t f = 0; f < layout.face_count; ++f) {
    const char* colour = p + word * (1 + integer(p, layout));
    p = skip_face(request.source, layout, p);
    if (colours.size() < models.size() && models[colours.size()] == f) {
      colours.emplace_back(colour, static_cast<std::size_t>(p - colour));
    }
  }
  out.write({first, static_cast<std::size_t>(p - first)});
  for (Eigen::Index f = 0; f < extension.F.rows(); ++f) {
    store(out, std::int32_t{3}, layout.swapped);
    for (const Index v : extension.F.row(f))
      store(out, v, layout.swapped);
    const Index model = extension.model_face[f];
    out.write(colours[position_in(models, model)]);
  }
  return p;
}

}  // namespace

Mesh read_binary_body(const SourceBytes& source, Layout& layout) {
  find_dialect(source, layout);
  Mesh mesh;
  mesh.X.resize(layout.vertex_count, 3);
  const char* p = layout.body + counts;
  for (std::int64_t v = 0; v < layout.vertex_count; ++v, p += vertex_row(layout)) {
    for (int c = 0; c < 3; ++c) {
      mesh.X(v, c) = load<float>(p + c * word, layout.swapped);
      if (!std::isfinite(mesh.X(v, c))) {
        fail_in_binary(source, "vertex", v, p + c * word, "not a finite number");
      }
    }
  }
  for (std::int64_t f = 0; f < layout.face_count; ++f) {
    read_face(source, layout, f, p, mesh.faces);
    p = skip_face(source, layout, p);
  }
  return mesh;
}

std::vector<std::string> patch_binary(const PatchRequest& request, const Layout& header,
                                      ByteSink& out) {
  const SourceBytes& source = request.source;
  Layout layout = header;
  find_dialect(source, layout);
  out.write({source.begin(), static_cast<std::size_t>(layout.body - source.begin())});
  for (const std::int64_t count : extended_counts(request, layout))
    store(out, static_cast<std::int32_t>(count), layout.swapped);

  std::vector<Index> rim;
  if (request.extension != nullptr) rim = sorted_once(request.extension->rim);
  Eigen::MatrixXd at_rim(rim.size(), layout.extra_columns());
  patch_vertices(request, layout, rim, at_rim, out);
  const char* rest = first_face(layout);
  bool rounded = request.any_moved;
  if (request.extension != nullptr) {
    append_vertices(request, layout, rim, at_rim, out);
    rest = append_faces(request, layout, out);
    rounded = rounded || request.extension->X.rows() > 0;
  }
  out.write({rest, static_cast<std::size_t>(source.end() - rest)});
  if (!rounded) return {};
  return {
      "binary OFF stores coordinates as float32; those of moved and new vertices are rounded to "
      "that"};
}

}  // namespace ibmfair::off
