// Fills every hole of a mesh with CGAL's triangulate_refine_and_fair_hole: what users would pick
// instead of `ibmfair fill`, for tools/fill_table.
//
//   cgal_fill IN OUT CONTINUITY      prints the seconds of the filling
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// What CGAL throws ends the program, as it should.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 4 || !pmp::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: cgal_fill IN OUT CONTINUITY\n";
    return 2;
  }
  const auto continuity = static_cast<unsigned>(std::stoi(argv[3]));
  const auto start = std::chrono::steady_clock::now();
  std::vector<Mesh::Halfedge_index> holes;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(holes));
  for (const Mesh::Halfedge_index hole : holes) {
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(mesh, hole, std::back_inserter(faces),
                                          std::back_inserter(vertices),
                                          CGAL::parameters::fairing_continuity(continuity));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << "\n";
  return CGAL::IO::write_polygon_mesh(argv[2], mesh, CGAL::parameters::stream_precision(17)) ? 0
                                                                                             : 6;
}
