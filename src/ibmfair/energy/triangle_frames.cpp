#include "ibmfair/energy/triangle_frames.h"

#include "ibmfair/base/parallel.h"
#include "ibmfair/mesh/geometry.h"

namespace ibmfair {

void update_frames(const Points& X, const Triangles& F, std::vector<TriangleFrame>& frames) {
  frames.resize(static_cast<std::size_t>(F.rows()));
  parallel_for(F.rows(), [&](std::int64_t t) {
    const Vec3 N = double_area_vector(X.row(F(t, 0)), X.row(F(t, 1)), X.row(F(t, 2)));
    const double length = N.norm();
    frames[t] = {N / length, length / 2};
  });
}

}  // namespace ibmfair
