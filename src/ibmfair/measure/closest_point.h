// The point of a surface that is closest to a given one.
#pragma once

#include <memory>

#include "ibmfair/base/types.h"

namespace ibmfair {

/// Answers for one triangle mesh; builds a tree of boxes once, O(#F log #F).
class ClosestPoint {
 public:
  struct Hit {
    Vec3 point;      ///< on the surface
    Index triangle;  ///< a row of F; of several equally close ones any, but always the same
    double distance;
  };

  /// Triangles without area are left out: a query has no answer on them, and the triangles around
  /// cover the same points. X and F are copied. Throws BadMesh if no triangle is left.
  ClosestPoint(const Points& X, const Triangles& F);
  ~ClosestPoint();
  ClosestPoint(const ClosestPoint&) = delete;
  ClosestPoint& operator=(const ClosestPoint&) = delete;

  /// The closest point to x. Any number of threads may ask at the same time.
  Hit operator()(const Vec3& x) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace ibmfair
