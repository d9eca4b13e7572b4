#include "commands/fill_picture.h"

#include <array>

#include "ibmfair/fill/patch_bound.h"
#include "ibmfair/picture/close_up.h"

namespace ibmfair::commands {
namespace {

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

void draw(const FillArguments& arguments, const Points& before, const Topology& topology,
          const Points& after, const Topology& topology_after, const RenderOptions& rendering) {
  const std::string& laplacian = arguments.fill.fairing.laplacian;
  const std::array<FieldState, 2> states{
      {{before, topology, nullptr, laplacian}, {after, topology_after, &before, laplacian}}};
  draw_picture(arguments.picture, arguments.output.write.overwrite, states, topology.F.rows(),
               rendering);
}

}  // namespace

void draw_filling(const FillArguments& arguments, const Points& X, const Topology& topology,
                  const Filling& filling, const Points& filled_X, const Topology& filled_topology) {
  if (!arguments.picture.path.empty()) {
    draw(arguments, X, topology, filled_X, filled_topology,
         view_of_largest_patch(filling, filled_X, filled_topology));
  }
}

void draw_region(const FillArguments& arguments, const Points& before, const Topology& topology,
                 const Points& after) {
  draw(arguments, before, topology, after, topology, {});
}

}  // namespace ibmfair::commands
