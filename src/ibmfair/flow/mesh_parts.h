// A mesh that is spread over several processes, as seen from one process.
//
// Each process runs the same flow on a piece of the mesh: the vertices that belong to its part, and
// the surrounding vertices that their stencils and triangles reach, which belong to other parts.
// Quantities of the whole mesh are computed through this class, so that all processes take the same
// decisions.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// This base class is for a mesh in one piece. A derived class communicates with other processes:
/// all processes must call its members in the same order, and get the same results.
class MeshParts {
 public:
  MeshParts() = default;
  MeshParts(const MeshParts&) = delete;
  MeshParts& operator=(const MeshParts&) = delete;
  virtual ~MeshParts() = default;

  /// The whole mesh.
  static const MeshParts& one();

  /// Flags of the vertices (#V) and triangles (#F) of the piece that belong to this part; empty if
  /// all do. Every vertex and triangle of the mesh belongs to exactly one part. Own vertices come
  /// before all others.
  const std::vector<std::uint8_t>& own_vertices() const { return own_vertices_; }
  const std::vector<std::uint8_t>& own_triangles() const { return own_triangles_; }
  bool owns_vertex(Index v) const { return own_vertices_.empty() || own_vertices_[v] != 0; }
  bool owns_triangle(Index t) const { return own_triangles_.empty() || own_triangles_[t] != 0; }
  bool is_whole() const { return is_whole_; }

  /// The sum and the maximum over all parts.
  virtual double sum(double x) const { return x; }
  virtual double max(double x) const { return x; }
  bool any(bool x) const { return max(x ? 1 : 0) > 0; }

  /// Replaces the rows (#V x 3) of vertices that belong to other parts by those parts' values.
  virtual void refresh(Points& /*rows*/) const {}

  /// Replaces the flags (#V) of vertices that belong to other parts by those parts' values.
  void refresh(std::vector<std::uint8_t>& flags) const;

 protected:
  /// The first `own` of the `vertices` vertices belong to this part.
  MeshParts(Index own, Index vertices, std::vector<std::uint8_t> own_triangles);

 private:
  bool is_whole_ = true;
  std::vector<std::uint8_t> own_vertices_, own_triangles_;
};

}  // namespace ibmfair
