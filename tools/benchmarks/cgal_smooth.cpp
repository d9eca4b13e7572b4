// Smooths a mesh with CGAL's smooth_shape (mean curvature flow) and CHOLMOD: an alternative
// to `ibmfair smooth`, for tools/bench.
//
//   cgal_smooth IN OUT ITERATIONS TIME      TIME is of all iterations, length^2; prints the seconds
//                                           of the smoothing
#include <chrono>
#include <iostream>
#include <string>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/CholmodSupport>

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Solver = CGAL::Eigen_solver_traits<
    Eigen::CholmodSupernodalLLT<CGAL::Eigen_sparse_matrix<double>::EigenType>>;

// An exception from CGAL ends the program, as intended.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 5 || !pmp::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: cgal_smooth IN OUT ITERATIONS TIME\n";
    return 2;
  }
  const int iterations = std::stoi(argv[3]);
  const double time = std::stod(argv[4]);
  const auto start = std::chrono::steady_clock::now();
  pmp::smooth_shape(
      faces(mesh), mesh, time / iterations,
      CGAL::parameters::number_of_iterations(iterations).sparse_linear_solver(Solver()));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << "\n";
  return CGAL::IO::write_polygon_mesh(argv[2], mesh, CGAL::parameters::stream_precision(17)) ? 0
                                                                                             : 6;
}
