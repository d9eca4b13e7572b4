#include "ibmfair/measure/closest_point.h"

#include <algorithm>
#include <vector>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<CGAL/AABB_traits_3.h>)  // CGAL 6 deprecates the names without 3.
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include "ibmfair/base/errors.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Iterator = std::vector<Triangle>::const_iterator;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Iterator>;
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif
using BoxTree = CGAL::AABB_tree<Traits>;

Kernel::Point_3 to_cgal(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

}  // namespace

struct ClosestPoint::Tree {
  std::vector<Triangle> triangles;
  std::vector<Index> number;  // the number of each triangle in the input
  BoxTree boxes;
};

ClosestPoint::ClosestPoint(const Points& X, const Triangles& F) : tree_(std::make_unique<Tree>()) {
  const std::vector<Index> degenerate = degenerate_triangles(X, F);
  for (Index f = 0; f < F.rows(); ++f) {
    if (!std::binary_search(degenerate.begin(), degenerate.end(), f)) {
      tree_->triangles.emplace_back(to_cgal(X.row(F(f, 0))), to_cgal(X.row(F(f, 1))),
                                    to_cgal(X.row(F(f, 2))));
      tree_->number.push_back(f);
    }
  }
  if (tree_->triangles.empty()) {
    throw BadMesh("distances need a surface, but no triangle has any area");
  }
  tree_->boxes.rebuild(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->boxes.build();
  tree_->boxes.accelerate_distance_queries();
}

ClosestPoint::~ClosestPoint() = default;

ClosestPoint::Hit ClosestPoint::operator()(const Vec3& x) const {
  const auto [point, primitive] = tree_->boxes.closest_point_and_primitive(to_cgal(x));
  const Vec3 y(point.x(), point.y(), point.z());
  return {y, tree_->number[static_cast<std::size_t>(primitive - tree_->triangles.cbegin())],
          (x - y).norm()};
}

}  // namespace ibmfair
