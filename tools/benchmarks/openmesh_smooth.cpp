// Smooths a mesh with OpenMesh's JacobiLaplaceSmootherT (C1 continuity, tangential and normal):
// an alternative to `ibmfair smooth`, for tools/bench.
//
//   openmesh_smooth IN OUT ITERATIONS      prints the seconds of the smoothing
#include <chrono>
#include <iostream>
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh>;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 4 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
    std::cerr << "usage: openmesh_smooth IN OUT ITERATIONS\n";
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  Smoother smoother(mesh);
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C1);
  smoother.smooth(std::stoi(argv[3]));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << "\n";
  constexpr std::streamsize digits = 9;
  return OpenMesh::IO::write_mesh(mesh, argv[2], OpenMesh::IO::Options::Default, digits) ? 0 : 6;
}
