// Replaces single faces of a mesh file, while everything else in the file stays as it is.
#pragma once

#include <string>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/io/mesh_file.h"

namespace ibmfair {

/// A corner of a new face: a corner of the old face, or a vertex on the way from one corner of the
/// old face to another.
struct EditedCorner {
  Index vertex = 0;
  Index from = 0, to = 0;  ///< corners of the old face, counted from 0; equal for an old corner
  double along = 0;        ///< share of the way, in 0 .. 1

  bool is_old() const { return from == to; }
};

/// A face, and the faces (of three or more corners) that take its place.
struct FaceEdit {
  Index face = 0;
  std::vector<std::vector<EditedCorner>> pieces;
};

/// The mesh with these faces replaced. `edits` are in ascending order of their faces.
Mesh with_edited_faces(const Mesh& mesh, const std::vector<FaceEdit>& edits);

/// A file with some faces replaced, and notes for the user about what could not be kept.
struct EditedFile {
  MeshFile file;
  std::vector<std::string> notes;
};

/// Replaces faces in the bytes of a file. Vertices keep their numbers and bytes. In OBJ, PLY and
/// OFF only the rows of these faces and the counts change. New faces take the group, material,
/// colour and properties of the old face; texture coordinates of corners, and in OBJ normals, are
/// interpolated between the corners of the old face. If the vertices of `source` were merged, or if
/// its format or the arrangement of its text does not permit this, the file is generated first:
/// then the result holds what a generated file of this format holds, and is PLY for a format that
/// cannot be edited. Throws CannotWrite if a face gets more corners than its PLY file can count.
EditedFile edit_faces(const MeshFile& source, const std::vector<FaceEdit>& edits);

}  // namespace ibmfair
