#include "ibmfair/io/face_edits.h"

#include <optional>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

MeshFile read_again(const MeshFile& source, MemorySink& out, const Format& format) {
  return read_mesh(SourceBytes::from_memory(source.name(), out.text()),
                   {.format = std::string(format.name)});
}

/// The file with its faces edited in place; nothing if that is not possible.
std::optional<MeshFile> edited_in_place(const MeshFile& source,
                                        const std::vector<FaceEdit>& edits) {
  const Format& format = source.format();
  MemorySink out;
  if (source.welded() || format.edit_faces == nullptr ||
      !format.edit_faces({source.bytes(), source.mesh(), edits}, out)) {
    return std::nullopt;
  }
  return read_again(source, out, format);
}

/// Text may declare float32 and hold other numbers, which must not be rounded.
CoordinateTypes types_that_hold(const Points& X) {
  return X.cast<float>().cast<double>() == X ? CoordinateTypes::as_declared
                                             : CoordinateTypes::float64;
}

}  // namespace

Mesh with_edited_faces(const Mesh& mesh, const std::vector<FaceEdit>& edits) {
  Mesh result;
  result.X = mesh.X;
  std::vector<Index> corners;
  auto edit = edits.begin();
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    if (edit == edits.end() || edit->face != f) {
      result.faces.add(mesh.faces[f]);
      continue;
    }
    for (const std::vector<EditedCorner>& piece : edit->pieces) {
      corners.clear();
      for (const EditedCorner& corner : piece)
        corners.push_back(corner.vertex);
      result.faces.add(corners);
    }
    ++edit;
  }
  return result;
}

EditedFile edit_faces(const MeshFile& source, const std::vector<FaceEdit>& edits) {
  if (auto edited = edited_in_place(source, edits)) return {*std::move(edited), {}};
  const bool same = source.format().edit_faces != nullptr;
  const Format& format = same ? source.format() : *find_format("ply");
  EditedFile result;
  MemorySink out;
  result.notes =
      format.generate({source.mesh(), source.attributes(), same ? &source.bytes() : nullptr,
                       types_that_hold(source.mesh().X)},
                      out);
  auto edited = edited_in_place(read_again(source, out, format), edits);
  if (!edited) {
    throw CannotWrite(fmt::format(
        "{}: --stitch gives a face more corners than the lists of this file can count; name an "
        "output in another format",
        source.name()));
  }
  result.file = *std::move(edited);
  return result;
}

}  // namespace ibmfair
