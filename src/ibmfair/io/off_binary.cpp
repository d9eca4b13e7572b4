// Binary OFF: big-endian with a number of colours after each face as Geomview writes it, or
// little-endian without as PMP does, or any mixture of the two. Nothing in the file says which; the
// one that ends exactly with the file is right.
#include <bit>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "ibmfair/io/binary_bytes.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair::off {
namespace {

constexpr std::int64_t word = 4;  // every number of the format has four bytes
constexpr std::int64_t counts = 3 * word;

std::int64_t vertex_row(const Layout& layout) {
  return word * (3 + layout.extra_columns());
}

std::int32_t integer(const char* p, const Layout& layout) {
  return load<std::int32_t>(p, layout.swapped);
}

/// Reads the counts; false where the file cannot hold as many rows.
bool read_counts(const SourceBytes& source, Layout& layout) {
  const std::int64_t room = source.end() - layout.body - counts;
  if (room < 0) return false;
  layout.vertex_count = integer(layout.body, layout);
  layout.face_count = integer(layout.body + word, layout);
  return layout.vertex_count >= 0 && layout.face_count >= 0 &&
         layout.vertex_count * vertex_row(layout) + layout.face_count * word <= room;
}

const char* first_face(const Layout& layout) {
  return layout.body + counts + layout.vertex_count * vertex_row(layout);
}

/// The end of a face that starts at `p`, nullptr where it does not fit the file.
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
                                      AtomicFile& out) {
  Layout layout = header;
  find_dialect(request.source, layout);
  std::optional<RenewedNormals> normals;
  if (layout.normal) {
    normals.emplace(request.mesh.faces, request.mesh.X, request.X, request.moved);
  }
  const char* row = layout.body + counts;
  out.write({request.source.begin(), static_cast<std::size_t>(row - request.source.begin())});
  for (std::int64_t v = 0; v < layout.vertex_count; ++v, row += vertex_row(layout)) {
    const auto store_row = [&](const char* old, const Vec3& value, bool replaced) {
      if (!replaced) return out.write({old, 3 * word});
      for (int c = 0; c < 3; ++c)
        store(out, static_cast<float>(value[c]), layout.swapped);
    };
    store_row(row, request.X.row(v), request.moved[static_cast<std::size_t>(v)] != 0);
    int written = 3;
    if (normals) {
      const char* old = row + 3 * word;
      Vec3 value;
      for (int c = 0; c < 3; ++c)
        value[c] = load<float>(old + c * word, layout.swapped);
      store_row(old, normals->renew(v, value), normals->is_stale(v));
      written = 6;
    }
    out.write(
        {row + written * word, static_cast<std::size_t>(vertex_row(layout) - written * word)});
  }
  out.write({row, static_cast<std::size_t>(request.source.end() - row)});
  return {"binary OFF stores coordinates as float32; those of moved vertices are rounded to that"};
}

}  // namespace ibmfair::off
