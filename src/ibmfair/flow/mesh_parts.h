// A mesh that is spread over several processes, as the flow sees it from one of them.
//
// Each process runs the same flow on a piece of the mesh: the vertices that belong to it, and
// around them what their stencils and triangles reach, which belongs to others. What the flow asks
// of the whole mesh goes through here, so that all processes decide alike.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ibmfair/base/types.h"

namespace ibmfair {

class JacobianSolver;
struct JacobianShape;

/// The mesh in one piece. A class derived from it knows of others; then its members are called by
/// all processes, in the same order, and return the same on all.
class MeshParts {
 public:
  MeshParts() = default;
  MeshParts(const MeshParts&) = delete;
  MeshParts& operator=(const MeshParts&) = delete;
  virtual ~MeshParts() = default;

  /// The whole mesh.
  static const MeshParts& one();

  /// #V and #F of the piece: whether they belong to this part; empty: all do. Every vertex and
  /// triangle of the mesh belongs to one part. Own vertices come before all others.
  const std::vector<std::uint8_t>& own_vertices() const { return own_vertices_; }
  const std::vector<std::uint8_t>& own_triangles() const { return own_triangles_; }
  bool owns_vertex(Index v) const { return own_vertices_.empty() || own_vertices_[v] != 0; }
  bool owns_triangle(Index t) const { return own_triangles_.empty() || own_triangles_[t] != 0; }
  bool is_whole() const { return is_whole_; }

  /// Over all parts.
  virtual double sum(double x) const { return x; }
  virtual double max(double x) const { return x; }
  bool any(bool x) const { return max(x ? 1 : 0) > 0; }

  /// Rows (#V x 3) of vertices that belong to other parts, from them.
  virtual void refresh(Points& /*rows*/) const {}

  /// Flags (#V) of vertices that belong to other parts, from them.
  void refresh(std::vector<std::uint8_t>& flags) const;

  /// What solves with the Jacobian over all parts, and notes its name in the report; null where any
  /// backend can.
  virtual std::unique_ptr<JacobianSolver> make_solver(const JacobianShape& shape) const;

 protected:
  /// Of `vertices` the first `own` are this part's.
  MeshParts(Index own, Index vertices, std::vector<std::uint8_t> own_triangles);

 private:
  bool is_whole_ = true;
  std::vector<std::uint8_t> own_vertices_, own_triangles_;
};

}  // namespace ibmfair
