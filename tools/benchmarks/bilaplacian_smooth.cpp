// Smooths a closed mesh with bi-Laplacian diffusion, one factorization by CHOLMOD for all steps:
// a simple alternative to `ibmfair smooth`, for tools/bench.
//
//   bilaplacian_smooth IN OUT STEPS TIME   TIME is of all steps, length^4; prints the seconds of
//                                          the smoothing
#include <chrono>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include "ibmfair/io/mesh_file.h"

namespace {

using ibmfair::Index;
using ibmfair::Points;
using ibmfair::Triangles;
using ibmfair::Vec3;
using Matrix = Eigen::SparseMatrix<double>;

/// The cotangent Laplacian, positive semi-definite, and a third of the area around each vertex.
void cotangent_laplacian(const Points& X, const Triangles& F, Matrix& L, Eigen::VectorXd& mass) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(12 * F.rows());
  mass = Eigen::VectorXd::Zero(X.rows());
  for (const auto& triangle : F.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const Index a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
      const Vec3 p = X.row(b) - X.row(a), q = X.row(c) - X.row(a);
      const double double_area = p.cross(q).norm();
      const double weight = p.dot(q) / double_area / 2;
      entries.insert(entries.end(),
                     {{b, b, weight}, {c, c, weight}, {b, c, -weight}, {c, b, -weight}});
      mass[a] += double_area / 6;
    }
  }
  L.resize(X.rows(), X.rows());
  L.setFromTriplets(entries.begin(), entries.end());
}

/// (M + h L M^-1 L) X_k+1 = M X_k with h = time / steps.
Points diffuse(const Points& start, const Triangles& F, int steps, double time) {
  Matrix L;
  Eigen::VectorXd mass;
  cotangent_laplacian(start, F, L, mass);
  const Matrix weighted = mass.cwiseInverse().asDiagonal() * L;
  Matrix J = time / steps * (L * weighted);
  J.diagonal() += mass;
  const Eigen::CholmodSupernodalLLT<Matrix> solver(J);
  Eigen::MatrixXd X = start;
  for (int step = 0; step < steps; ++step) {
    X = solver.solve(mass.asDiagonal() * X).eval();
  }
  return X;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: bilaplacian_smooth IN OUT STEPS TIME\n";
    return 2;
  }
  try {
    const ibmfair::MeshFile file = ibmfair::read_mesh(argv[1]);
    const Triangles F = triangulate(file.mesh()).F;
    const auto start = std::chrono::steady_clock::now();
    const Points X = diffuse(file.mesh().X, F, std::stoi(argv[3]), std::stod(argv[4]));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << seconds.count() << "\n";
    write_mesh(file, X, argv[2], {.overwrite = true});
  } catch (const std::exception& error) {
    std::cerr << "bilaplacian_smooth: " << error.what() << "\n";
    return 1;
  }
}
