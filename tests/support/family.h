// All members of the family of energies: every Laplacian with every mass that goes with it.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/laplacian_matrices.h"

namespace ibmfair::test {

struct Member {
  std::string laplacian, mass;

  EnergyOptions options() const { return {true, {}, mass}; }
  /// Whether the axioms (M2) and (M3) hold; masses without them are no mass matrices.
  bool measures_area() const { return mass != "none" && mass != "valence"; }

  /// Whether axiom (L4) holds: the Laplacian is zero on planes.
  bool is_flat_on_planes() const { return laplacian != "umbrella"; }
  /// Whether the stencils of the Hessian are the stencils of the energy itself.
  bool has_own_hessian() const { return laplacian != "intrinsic-delaunay" && mass != "galerkin"; }

  std::unique_ptr<BendingEnergy> create(const Topology& topology) const {
    return bending_model(laplacian).create(topology, options());
  }
  LaplacianMatrices matrices(const Points& X, const Topology& topology) const {
    return bending_model(laplacian).matrices(X, topology, options());
  }
  double energy(const Points& X, const Topology& topology) const {
    return create(topology)->energy(X);
  }
};

inline std::ostream& operator<<(std::ostream& out, const Member& member) {
  return out << member.laplacian << " with mass " << member.mass;
}

/// The name of the member in the form that the names of tests may have.
inline std::string identifier(const Member& member) {
  std::string name = member.laplacian + "_" + member.mass;
  for (char& c : name) {
    c = c == '-' ? '_' : c;
  }
  return name;
}

inline std::vector<Member> family() {
  std::vector<Member> members;
  for (const BendingModel& model : bending_models()) {
    for (const std::string_view mass : model.masses) {
      members.push_back({std::string(model.name), std::string(mass)});
    }
  }
  return members;
}

inline Eigen::MatrixXd dense(const SymmetricMatrix& A) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(A.size(), A.size());
  for (std::int64_t j = 0; j < A.size(); ++j) {
    for (std::int64_t k = A.column_first[j]; k < A.column_first[j + 1]; ++k) {
      result(A.row[k], j) = result(j, A.row[k]) = A.value[k];
    }
  }
  return result;
}

}  // namespace ibmfair::test
