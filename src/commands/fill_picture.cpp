#include "commands/fill_picture.h"

#include "ibmfair/fill/patch_bound.h"
#include "ibmfair/picture/close_up.h"

namespace ibmfair::commands {

RenderOptions view_of_largest_patch(const Filling& filling, const Points& X,
                                    const Topology& topology) {
  auto next = static_cast<Index>(topology.F.rows() - filling.new_F.rows());
  Index first = 0, count = 0;
  double largest = 0;
  for (const Patch& patch : filling.patches) {  // in the order of their triangles
    if (const double area = patch_area(patch); area > largest) {
      largest = area;
      first = next;
      count = patch.net.size();
    }
    next += patch.net.size();
  }
  return close_up(X, topology, first, count);
}

}  // namespace ibmfair::commands
