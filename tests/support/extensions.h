// Something to append to a mesh, with weights in place of the solver that extends functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/extension.h"

namespace ibmfair::test {

/// Over each of the given faces a tent of three new vertices: p, joined to every corner; q in the
/// first of p's triangles; and r, joined to p and q only. The model face is the face itself. The
/// rim is the corners; each new vertex is a mean of them, all weights being powers of two, plus an
/// offset in its position. The orientation is the face's own.
struct Tents {
  Tents(const Mesh& mesh, const std::vector<Index>& faces);

  Extension extension;
  Eigen::MatrixXd weights;  ///< #new vertices x #rim, what `extension.extend` multiplies by
};

/// The bytes of a mesh file called `name`, written in its own format with a tent over one face.
std::string with_tent(std::string_view bytes, const std::string& name, Index face = 0,
                      WriteReport* report = nullptr, const WriteOptions& options = {});

/// Every `step`-th face of a mesh.
std::vector<Index> some_faces(const Mesh& mesh, Index step);

}  // namespace ibmfair::test
