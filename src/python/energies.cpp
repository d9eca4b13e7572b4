#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/laplacian_matrices.h"
#include "ibmfair/mesh/topology.h"
#include "interpreter_lock.h"

namespace py = pybind11;

namespace ibmfair::python {
namespace {

Topology topology_of(const Mesh& mesh) {
  return build_topology(mesh.X, triangulate(mesh).F);
}

/// The mass matrix "none" has a name of its own in the options.
EnergyOptions options_of(const std::string& mass, const Eigen::VectorXd& spontaneous_curvature) {
  EnergyOptions options;
  options.mass = mass != "none";
  options.mass_matrix = options.mass ? mass : "";
  options.spontaneous_curvature = spontaneous_curvature;
  return options;
}

py::tuple energy(const Array<double>& V, const Array<std::int64_t>& first,
                 const Array<std::int32_t>& corner, const std::string& laplacian,
                 const std::string& mass, const Array<double>& h0, bool with_gradient) {
  const Mesh mesh{points_of(V), polygons_of(first, corner)};
  const Eigen::VectorXd curvature = Eigen::VectorXd::Map(h0.data(), h0.size());
  double value = 0;
  Points G;
  {
    const Unlocked unlocked;
    const Topology topology = topology_of(mesh);
    const auto bending = bending_model(laplacian).create(topology, options_of(mass, curvature));
    value = with_gradient ? bending->energy_and_gradient(mesh.X, G) : bending->energy(mesh.X);
  }
  return py::make_tuple(value, with_gradient ? py::object(array_of(std::move(G))) : py::none());
}

/// The lower triangle as (row, column, value) with the numbers of vertices or edges.
py::tuple triplets(const SymmetricMatrix& matrix, const std::vector<Index>& nodes) {
  std::vector<Index> row, column;
  row.reserve(matrix.row.size());
  column.reserve(matrix.row.size());
  for (std::int64_t j = 0; j < matrix.size(); ++j) {
    for (std::int64_t k = matrix.column_first[j]; k < matrix.column_first[j + 1]; ++k) {
      row.push_back(nodes[matrix.row[k]]);
      column.push_back(nodes[j]);
    }
  }
  return py::make_tuple(array_of(row), array_of(column), array_of(matrix.value));
}

py::tuple laplacian(const Array<double>& V, const Array<std::int64_t>& first,
                    const Array<std::int32_t>& corner, const std::string& name,
                    const std::string& mass) {
  const Mesh mesh{points_of(V), polygons_of(first, corner)};
  LaplacianMatrices matrices;
  Edges edges;
  {
    const Unlocked unlocked;
    const Topology topology = topology_of(mesh);
    const BendingModel& model = bending_model(name);
    const EnergyOptions options = options_of(mass, {});
    model.create(topology, options);  // throws for a mass matrix that does not fit
    matrices = model.matrices(mesh.X, topology, options);
    edges = topology.E;
  }
  const auto size = matrices.edge_based ? edges.rows() : mesh.X.rows();
  return py::make_tuple(size, triplets(matrices.L, matrices.nodes),
                        triplets(matrices.M, matrices.nodes));
}

py::array_t<std::int32_t> edges(const Array<double>& V, const Array<std::int64_t>& first,
                                const Array<std::int32_t>& corner) {
  const Topology topology = topology_of({points_of(V), polygons_of(first, corner)});
  py::array_t<std::int32_t> result({topology.E.rows(), Eigen::Index{2}});
  std::copy_n(topology.E.data(), topology.E.size(), result.mutable_data());
  return result;
}

py::array_t<std::int32_t> triangles(const Array<double>& V, const Array<std::int64_t>& first,
                                    const Array<std::int32_t>& corner) {
  return array_of(triangulate({points_of(V), polygons_of(first, corner)}).F);
}

}  // namespace

void bind_energies(py::module_& module) {
  module.def("energy", &energy);
  module.def("laplacian", &laplacian);
  module.def("edges", &edges);
  module.def("triangles", &triangles);
}

}  // namespace ibmfair::python
