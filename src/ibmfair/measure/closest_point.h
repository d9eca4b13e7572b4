// Closest points on a surface.
#pragma once

#include <memory>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Closest-point queries on one triangle mesh. The constructor builds a tree of boxes in O(#F log
/// #F).
class ClosestPoint {
 public:
  struct Hit {
    Vec3 point;      ///< on the surface
    Index triangle;  ///< a row of F; among equally close ones any, but always the same
    double distance;
  };

  /// Triangles without area are left out: a query has no answer on them, and adjacent triangles
  /// cover the same points. X and F are copied. Throws BadMesh if no triangle is left.
  ClosestPoint(const Points& X, const Triangles& F);
  ~ClosestPoint();
  ClosestPoint(const ClosestPoint&) = delete;
  ClosestPoint& operator=(const ClosestPoint&) = delete;

  /// The closest point to x. May be called by several threads at the same time.
  Hit operator()(const Vec3& x) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ibmfair
