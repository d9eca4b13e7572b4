// An extension to append to a mesh. Fixed weights stand in place of the solver that extends
// functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/extension.h"

namespace ibmfair::test {

/// A tent of three new vertices over each of the given faces: p is joined to every corner of the
/// face; q lies in the first of p's triangles; r is joined to p and q only. The model face of a
/// tent is the face below it. The rim consists of the corners of the faces. Each new vertex is a
/// weighted mean of these corners, with powers of two as weights, plus an offset in its position. A
/// tent has the orientation of its face.
struct Tents {
  Tents(const Mesh& mesh, const std::vector<Index>& faces);

  Extension extension;
  Eigen::MatrixXd weights;  ///< #new vertices x #rim, the factor in `extension.extend`
};

/// The bytes of the mesh file called `name`, written in the format of that file, with a tent over
/// one face.
std::string with_tent(std::string_view bytes, const std::string& name, Index face = 0,
                      WriteReport* report = nullptr, const WriteOptions& options = {});

/// Every `step`-th face of a mesh.
std::vector<Index> some_faces(const Mesh& mesh, Index step);

}  // namespace ibmfair::test
