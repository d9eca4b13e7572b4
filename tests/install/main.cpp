// A program of another project that uses the library: the bending energy of an icosphere, which
// tends to 8 pi.
#include <iostream>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/picture/png.h"
#include "ibmfair/picture/render.h"
#include "ibmfair/shapes/polyhedra.h"

int main() {
  const ibmfair::TriangleMesh sphere = ibmfair::make_icosphere({.levels = 4});
  const ibmfair::Topology topology = ibmfair::build_topology(sphere.X, sphere.F);
  std::cout << "energy " << ibmfair::bending_energy(sphere.X, topology) << '\n';
  const auto picture = ibmfair::render({sphere.X, sphere.F}, {.width = 64, .height = 64});
  return ibmfair::encode_png(picture).empty() ? 1 : 0;
}
